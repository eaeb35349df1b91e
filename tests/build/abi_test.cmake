# SPDX-License-Identifier: MIT
# The binary interface is that of the last release, tests/build/topoadapt.abi, or has grown from it as the header promises
# (Versions): new functions, new numbers in enums, new fields at the end of structures that begin with struct_size.
# After a release, or a change that a new minor version may make: TOPOADAPT_WRITE_ABI=1 ctest -R abi_test writes it anew.
# cmake -DSOURCE= -DCXX=g++ -DABIDW= -DABIDIFF= -DFOLDER= -P abi_test.cmake
cmake_policy(VERSION 3.22)
set(released ${SOURCE}/tests/build/topoadapt.abi)

function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER} RESULT_VARIABLE status OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER})
file(READ ${SOURCE}/include/topoadapt.h header)

# All exported functions in one object with debug information, and a function that shows the enums.
file(GLOB sources RELATIVE ${SOURCE}/src ${SOURCE}/src/api/*.cpp)
list(SORT sources)
set(unit "")
foreach(source IN LISTS sources)
  string(APPEND unit "#include \"${source}\"\n")
endforeach()
string(REGEX MATCHALL "\nenum tpa_[a-z_]+" enums "${header}")
list(TRANSFORM enums REPLACE "\nenum " "")
list(LENGTH enums count)
if(count LESS 7)
  message(FATAL_ERROR "only ${count} enums in topoadapt.h: not read as expected")
endif()
list(JOIN enums ", " enums)
file(WRITE ${FOLDER}/api.cpp "${unit}extern \"C\" TPA_API void tpa_enums(${enums}) {}\n")
run(${CXX} -std=c++20 -g -fPIC -shared -fvisibility=hidden -fno-exceptions -fno-rtti -ffp-contract=off -DTPA_BUILD
  -DTPA_SHARED  -DTPA_PLAIN_LANES -I${SOURCE}/include -I${SOURCE}/src api.cpp -o libapi.so)
run(${ABIDW} --drop-private-types --headers-dir ${SOURCE}/include --exported-interfaces-only --no-elf-needed
  --no-corpus-path --no-comp-dir-path --no-show-locs --out-file now.abi libapi.so)

if(DEFINED ENV{TOPOADAPT_WRITE_ABI})
  file(COPY_FILE ${FOLDER}/now.abi ${released})
endif()

# Structures that begin with struct_size may have new fields behind their old size, and old fields as they were.
file(READ ${released} dump)
string(REGEX MATCHALL "struct tpa_[a-z_]+ {\n  uint32_t struct_size" growing "${header}")
set(growth "")
foreach(struct IN LISTS growing)
  string(REGEX REPLACE "struct (tpa_[a-z_]+) .*" "\\1" struct "${struct}")
  if(dump MATCHES "<class-decl name='${struct}' size-in-bits='([0-9]+)'")
    string(APPEND growth "[suppress_type]\n  name = ${struct}\n  type_kind = struct\n"
      "  has_data_member_inserted_between = {${CMAKE_MATCH_1}, end}\n")
  endif()
endforeach()
file(WRITE ${FOLDER}/growth.ini "${growth}")
execute_process(COMMAND ${ABIDIFF} --suppressions ${FOLDER}/growth.ini --no-added-syms ${released} ${FOLDER}/now.abi
  RESULT_VARIABLE status OUTPUT_VARIABLE differences ERROR_VARIABLE differences)
# The suppression is for all of a structure that grows.
execute_process(COMMAND ${ABIDIFF} --no-added-syms ${released} ${FOLDER}/now.abi OUTPUT_VARIABLE all ERROR_VARIABLE all)
if(all MATCHES "data member (change|deletion)")
  set(status 1)
  set(differences "${all}")
endif()
if(NOT status EQUAL 0)
  message(FATAL_ERROR "Programs of the last release would break. docs/versioning.md says when this is allowed.\n${differences}")
endif()
