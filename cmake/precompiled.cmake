# Headers that most files read take half of what a file takes to compile; read once, they do not.
# Other compilers cannot read what GCC made of them, so clang-tidy's configuration goes without.
option(FLEXURA_PRECOMPILE "Precompile headers of libraries" ON)

function(flexura_precompile target)
  if(FLEXURA_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <Eigen/Dense> <algorithm> <array> <cmath> <complex>
                              <functional> <memory> <numbers> <optional> <span> <string> <variant>
                              <vector> <fmt/format.h> ${ARGN})
  endif()
endfunction()
