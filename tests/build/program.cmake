# SPDX-License-Identifier: MIT
# cmake -D BUILD=... -D SOURCE=... -D FOLDER=... -D NAME=game -D COMPILER=... -D CXX_COMPILER=... -P program.cmake
# Builds examples/NAME against a library installed under FOLDER, and plays through what tests/build/program_NAME.cmake
# says. Where a tool is missing the output says SKIPPED, and why.
function(run output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${text}${errors}")
  endif()
  set(${output} "${text}${errors}" PARENT_SCOPE)
endfunction()

# expect(TEXT REGEX): in what a program printed.
function(expect text regex)
  if(NOT text MATCHES "${regex}")
    message(FATAL_ERROR "no ${regex} in\n${text}")
  endif()
endfunction()

# line_of(TEXT NAME OUTPUT): the line that begins so.
function(line_of text name output)
  string(REGEX MATCH "(^|\n)${name} [^\n]*" line "${text}")
  if(line STREQUAL "")
    message(FATAL_ERROR "no line ${name} in\n${text}")
  endif()
  set(${output} "${line}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(ignored ${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/prefix)
# Eigen takes seconds of each source.
set(unity OFF)
if(NAME STREQUAL "solver")
  set(unity ON)
endif()
run(configured ${CMAKE_COMMAND} -S ${SOURCE}/examples/${NAME} -B ${FOLDER}/build -DCMAKE_PREFIX_PATH=${FOLDER}/prefix
  -DCMAKE_UNITY_BUILD=${unity} -DCMAKE_C_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_C_FLAGS=-Werror -DCMAKE_CXX_FLAGS=-Werror)
run(ignored ${CMAKE_COMMAND} --build ${FOLDER}/build --parallel 2)
include(${CMAKE_CURRENT_LIST_DIR}/program_${NAME}.cmake)
