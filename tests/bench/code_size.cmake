# cmake -D SOURCE=... -D BINARY=... -D ARCHIVE=... -D SIZE=... -D DIGEST=... -P code_size.cmake
# Prints the code and constants of the library beside the handle table: as built here, and for Cortex-M4 at -Os where
# there is a compiler for it; and runs a merge in that code, where there is QEMU, whose digests must be those of here.

function(print_size archive size_tool what goal)
  execute_process(COMMAND ${size_tool} ${archive} OUTPUT_VARIABLE sizes COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${sizes}")
  set(code 0)
  set(table 0)
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^ *([0-9]+)[ \t]+([0-9]+)[ \t]+[0-9]+[ \t]+[0-9]+[ \t]+[0-9a-f]+[ \t]+([^ ]+)")
      continue()
    endif()
    math(EXPR bytes "${CMAKE_MATCH_1} + ${CMAKE_MATCH_2}")
    if(CMAKE_MATCH_3 MATCHES "^handle_table")
      math(EXPR table "${table} + ${bytes}")
    else()
      math(EXPR code "${code} + ${bytes}")
    endif()
  endforeach()
  math(EXPR kib "(${code} + 512) / 1024")
  message("${what}: ${code} bytes (${kib} KiB; goal ${goal} KiB) beside ${table} bytes of handle table")
endfunction()

print_size(${ARCHIVE} ${SIZE} "This machine, -O2" 256)

find_program(cross_compiler arm-none-eabi-g++)
find_program(cross_size arm-none-eabi-size)
if(NOT cross_compiler OR NOT cross_size)
  message("Cortex-M: no arm-none-eabi-g++")
  return()
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY} -D CMAKE_TOOLCHAIN_FILE=${SOURCE}/cmake/cortex_m.cmake
  -D CMAKE_BUILD_TYPE=MinSizeRel -D TOPOADAPT_TOOL=OFF -D TOPOADAPT_TESTS=OFF -D TOPOADAPT_DIGEST=ON
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BINARY} --target merge_digest -j2 OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
print_size(${BINARY}/libtopoadapt.a ${cross_size} "Cortex-M4, -Os" 160)

find_program(emulator qemu-arm)
if(NOT emulator)
  message("Cortex-M: no qemu-arm")
  return()
endif()
execute_process(COMMAND ${DIGEST} OUTPUT_VARIABLE here COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${emulator} ${BINARY}/tests/digest/merge_digest OUTPUT_VARIABLE there
  RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT here STREQUAL there)
  message(FATAL_ERROR "A merge in code for Cortex-M4 (${result}):\n${there}here:\n${here}")
endif()
message("A merge in code for Cortex-M4 has the digests of this machine")
