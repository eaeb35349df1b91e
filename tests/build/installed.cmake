# cmake -D BUILD=... -D SOURCE=... -D FOLDER=... -P installed.cmake: installs the library under FOLDER, builds the example of
# README against what is there, and runs it.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/build/installed -B ${FOLDER}/build -DCMAKE_PREFIX_PATH=${FOLDER}/prefix
  -DEXAMPLE=${SOURCE}/examples/minimal.c -DCMAKE_C_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
run(${FOLDER}/build/with_topoadapt)
run(${FOLDER}/build/with_topoadapt_shared)
