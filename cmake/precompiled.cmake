# Headers that most files read, read once per target. Not in what users run: from precompiled headers
# GCC 12 gives warnings that it keeps to itself otherwise, and clang-tidy cannot read them.
option(FLEXURA_PRECOMPILE "Precompile headers of libraries" OFF)

function(flexura_precompile target)
  if(FLEXURA_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <Eigen/Dense> <algorithm> <array> <cmath> <complex>
                              <functional> <memory> <numbers> <optional> <span> <string> <variant>
                              <vector> <fmt/format.h> ${ARGN})
  endif()
endfunction()
