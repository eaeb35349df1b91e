# SPDX-License-Identifier: MIT
# topoadapt.hpp by this compiler and by clang++ where there is one, as C++17 and C++20: a strict program compiles without a
# warning, links with a second source that includes the header, and runs.
# cmake -DSOURCE= -DARCHIVE=libtopoadapt.a -DCXX= -DFOLDER= -P hpp_compilers.cmake
cmake_policy(VERSION 3.22)
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(WRITE ${FOLDER}/other.cpp "#include <topoadapt.hpp>\n"
  "double volume_of(topoadapt::Mesh& mesh) { return mesh.validate().volume; }\n")
find_program(CLANGXX clang++)
set(compilers ${CXX})
if(CLANGXX)
  list(APPEND compilers ${CLANGXX})
endif()
list(REMOVE_DUPLICATES compilers)
foreach(compiler IN LISTS compilers)
  foreach(standard 17 20)
    run(${compiler} -std=c++${standard} -pedantic -Wall -Wextra -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast
      -Wcast-qual -Wnon-virtual-dtor -Werror -I${SOURCE}/include ${SOURCE}/examples/heat.cpp other.cpp ${ARCHIVE} -o heat)
    run(${FOLDER}/heat)
  endforeach()
endforeach()
