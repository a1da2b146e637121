# What every target of the project is compiled with.
add_library(flexura_options INTERFACE)
target_compile_options(flexura_options INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wnon-virtual-dtor
  -fno-math-errno  # nobody reads errno after a square root
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # false alarms of GCC 12 (bug 105651)
  $<$<BOOL:${FLEXURA_WERROR}>:-Werror>
  # Null and wild pointers are found by the address sanitizer; checked twice, the build takes twice
  # as long.
  $<$<BOOL:${FLEXURA_SANITIZE}>:-fsanitize=address,undefined -fno-sanitize-recover=all
    -fno-sanitize=null,alignment,vptr,object-size -fno-omit-frame-pointer -Wno-maybe-uninitialized>
  $<$<BOOL:${FLEXURA_FUZZ}>:-fsanitize=fuzzer-no-link,address,undefined
    -fno-sanitize-recover=undefined -fno-sanitize=null,alignment,vptr,object-size>
  $<$<BOOL:${FLEXURA_COVERAGE}>:--coverage>)
target_link_options(flexura_options INTERFACE
  $<$<BOOL:${FLEXURA_SANITIZE}>:-fsanitize=address,undefined>
  $<$<BOOL:${FLEXURA_FUZZ}>:-fsanitize=address,undefined>
  $<$<BOOL:${FLEXURA_COVERAGE}>:--coverage>)
