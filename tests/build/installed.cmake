# SPDX-License-Identifier: MIT
# cmake -D BUILD=... -D SOURCE=... -D FOLDER=... -D COMPILER=... -P installed.cmake: installs the library under FOLDER with
# an include folder of its own, builds the example of README against it, and runs the example and the tool.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
foreach(installed include/topoadapt.h share/doc/topoadapt/LICENSE share/doc/topoadapt/topoadapt.spdx.json
    bin/topoadapt)
  if(NOT EXISTS ${FOLDER}/prefix/${installed})
    message(FATAL_ERROR "${installed} is not installed")
  endif()
endforeach()
run(${FOLDER}/prefix/bin/topoadapt handles 5 4 3)
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/build/installed -B ${FOLDER}/build -DCMAKE_PREFIX_PATH=${FOLDER}/prefix
  -DEXAMPLE=${SOURCE}/examples/minimal.c -DCMAKE_C_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
foreach(library topoadapt topoadapt_static topoadapt_shared)
  run(${FOLDER}/build/with_${library})
endforeach()
