# SPDX-License-Identifier: MIT
# cmake -D BUILD=... -D SOURCE=... -D FOLDER=... -D COMPILER=... -P installed.cmake: installs the library under FOLDER with
# an include folder of its own, builds the example of README against it, and runs the example and the tool.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
endfunction()

# As C projects without CMake build, from an installed tree that has moved.
function(build_by_pkg_config)
  file(GLOB_RECURSE description ${FOLDER}/moved/topoadapt.pc)
  get_filename_component(folder ${description} DIRECTORY)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PKG_CONFIG_PATH=${folder} ${PKG_CONFIG} --cflags --libs topoadapt
    OUTPUT_VARIABLE flags RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "pkg-config: ${status}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  get_filename_component(libraries ${folder} DIRECTORY)
  run(${COMPILER} ${EXAMPLE} ${flags} -Wl,-rpath,${libraries} -o ${FOLDER}/by_pkg_config)
  run(${FOLDER}/by_pkg_config)
  # With the static library, the program runs wherever it is.
  run(${COMPILER} ${EXAMPLE} -Wl,-Bstatic ${flags} -Wl,-Bdynamic -o ${FOLDER}/by_pkg_config_statically)
  run(${FOLDER}/by_pkg_config_statically)
endfunction()

set(EXAMPLE ${SOURCE}/examples/minimal.c)
file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
foreach(installed include/topoadapt.h include/topoadapt.hpp share/doc/topoadapt/LICENSE share/doc/topoadapt/topoadapt.spdx.json
    share/man/man1/topoadapt.1 bin/topoadapt)
  if(NOT EXISTS ${FOLDER}/prefix/${installed})
    message(FATAL_ERROR "${installed} is not installed")
  endif()
endforeach()
run(${FOLDER}/prefix/bin/topoadapt handles 5 4 3)
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/build/installed -B ${FOLDER}/build -DCMAKE_PREFIX_PATH=${FOLDER}/prefix
  -DEXAMPLE=${EXAMPLE} -DCMAKE_C_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${FOLDER}/build)
foreach(library topoadapt topoadapt_static topoadapt_shared)
  run(${FOLDER}/build/with_${library})
endforeach()
if(PKG_CONFIG)
  file(RENAME ${FOLDER}/prefix ${FOLDER}/moved)
  build_by_pkg_config()
endif()
