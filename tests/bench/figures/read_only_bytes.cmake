# SPDX-License-Identifier: MIT
# Bytes of read-only data that the handle database takes, by the symbols of its object files.
# cmake -DNM=nm -DARCHIVE=libtopoadapt.a -P read_only_bytes.cmake

execute_process(COMMAND ${NM} -P -t d ${ARCHIVE} OUTPUT_VARIABLE text ERROR_VARIABLE error RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${NM}: ${result}: ${error}")
endif()
string(REPLACE ";" "," text "${text}")
string(REGEX REPLACE "\n+" ";" text "${text}")

# POSIX format: archive[member]: and then name, type, value, size.
set(sum 0)
set(member "")
foreach(line IN LISTS text)
  if(line MATCHES "^[^ ]*\\[([^ ]+)\\]:$")
    set(member ${CMAKE_MATCH_1})
  elseif(member MATCHES "^handle_table" AND line MATCHES "^[^ ]+ [rR] [0-9]+ 0*([0-9]+)")
    math(EXPR sum "${sum} + ${CMAKE_MATCH_1}")
  endif()
endforeach()
if(sum EQUAL 0)
  message(FATAL_ERROR "no read-only data in handle_table*: ${ARCHIVE} not read as expected")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -E echo "The database takes ${sum} bytes of read-only data.\n")
