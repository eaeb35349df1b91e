# SPDX-License-Identifier: MIT
# The library as one source: compiles without warnings by this compiler and by clang++ where there is one, asks for four
# functions, and plays the scenes of tests/portability with the same bits, also where the processor could fuse a * b + c.
# cmake -DPYTHON= -DSOURCE= -DTABLES=printer -DC= -DCXX= -DNM= -DFOLDER= -P amalgamation_test.cmake
cmake_policy(VERSION 3.22)
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
execute_process(COMMAND ${TABLES} OUTPUT_FILE ${FOLDER}/tables.cpp COMMAND_ERROR_IS_FATAL ANY)
run(${PYTHON} ${SOURCE}/cmake/amalgamate.py ${SOURCE} ${FOLDER} ${FOLDER}/tables.cpp)

set(strict -std=c++20 -Wall -Wextra -Werror -pedantic)
find_program(CLANG clang++)
if(CLANG)
  run(${CLANG} ${strict} -fsyntax-only topoadapt.cpp)
endif()
# Without -ffp-contract=off, and with the instructions of this processor if the compiler knows them.
execute_process(COMMAND ${CXX} -march=native -fsyntax-only -x c++ /dev/null RESULT_VARIABLE unknown OUTPUT_QUIET ERROR_QUIET)
set(machine -march=native)
if(NOT unknown EQUAL 0)
  set(machine)
endif()
run(${CXX} ${strict} -O1 ${machine} -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno -c topoadapt.cpp
  -o topoadapt.o)
run(${NM} -u topoadapt.o)
string(REGEX MATCHALL "[A-Za-z_][A-Za-z0-9_]+" wanted "${output}")
list(REMOVE_ITEM wanted memcpy memmove memset memcmp _GLOBAL_OFFSET_TABLE_)
if(wanted)
  message(FATAL_ERROR "topoadapt.cpp needs ${wanted}")
endif()

set(scenes ${SOURCE}/tests/portability)
run(${C} -std=c99 -ffp-contract=off -DSCENES_MAIN -I${FOLDER} ${scenes}/scenes.c ${scenes}/calls.c ${scenes}/meshes.c
  topoadapt.o -lm -o scenes)
execute_process(COMMAND ${FOLDER}/scenes OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
file(READ ${scenes}/expected.txt expected)
if(NOT lines STREQUAL expected)
  message(FATAL_ERROR "The scenes have other results:\n${lines}")
endif()
