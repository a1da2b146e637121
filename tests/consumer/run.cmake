# Installs the library under a folder of its own, builds a project against it that knows nothing
# of this checkout, and runs that. Variables: BUILD, SOURCE, WORK, GENERATOR, COMPILER, LAUNCHER,
# MODEL, EXPECTED (what the output must contain).
file(REMOVE_RECURSE ${WORK})

function(run)
  execute_process(COMMAND ${ARGV} OUTPUT_VARIABLE output ERROR_VARIABLE output
                  RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGV} ended with ${status}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix --component development)
# Elsewhere than it was installed: nothing may remember the first place.
file(RENAME ${WORK}/prefix ${WORK}/moved)
run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${SOURCE} -B ${WORK}/build
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
    -DCMAKE_PREFIX_PATH=${WORK}/moved)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer ${MODEL})
message("${output}")
if(NOT output MATCHES "${EXPECTED}")
  message(FATAL_ERROR "'${EXPECTED}' was expected")
endif()
