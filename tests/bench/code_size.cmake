# SPDX-License-Identifier: MIT
# cmake -D SOURCE=... -D BINARY=... -D ARCHIVE=... -D SIZE=... -D DIGEST=... -P code_size.cmake
# Prints the bytes of code and constants of the library, handle tables apart: as built here and, with a cross compiler,
# for Cortex-M at -Os. Runs a merge in that code under QEMU; its digests must equal those of this machine.

# Sums code and constants of an archive: of the handle tables and of all other objects.
function(print_size what archive size_tool)
  execute_process(COMMAND ${size_tool} ${archive} OUTPUT_VARIABLE sizes COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${sizes}")
  set(tables 0)
  set(code 0)
  foreach(line IN LISTS lines)
    # text, data, bss, dec, hex, file name
    if(NOT line MATCHES "^ *([0-9]+)[ \t]+([0-9]+)[ \t]+[0-9]+[ \t]+[0-9]+[ \t]+[0-9a-f]+[ \t]+([^ ]+)")
      continue()
    endif()
    math(EXPR bytes "${CMAKE_MATCH_1} + ${CMAKE_MATCH_2}")
    if(CMAKE_MATCH_3 MATCHES "^handle_table")
      math(EXPR tables "${tables} + ${bytes}")
    else()
      math(EXPR code "${code} + ${bytes}")
    endif()
  endforeach()
  message("${what}: ${code} bytes of code and constants, ${tables} bytes of handle tables")
endfunction()

print_size("This machine" ${ARCHIVE} ${SIZE})

find_program(cross_size arm-none-eabi-size)
find_program(emulator qemu-arm)
if(NOT cross_size)
  message("Cortex-M: no arm-none-eabi tools")
  return()
endif()
execute_process(COMMAND ${DIGEST} OUTPUT_VARIABLE here COMMAND_ERROR_IS_FATAL ANY)
foreach(cpu 4 7)
  set(built ${BINARY}${cpu})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${built}
    -D CMAKE_TOOLCHAIN_FILE=${SOURCE}/cmake/cortex_m.cmake -D CORTEX_M=${cpu} -D CMAKE_BUILD_TYPE=MinSizeRel
    -D TOPOADAPT_TOOL=OFF -D TOPOADAPT_TESTS=OFF -D TOPOADAPT_DIGEST=ON OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${built} --target merge_digest -j2 OUTPUT_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
  print_size("Cortex-M${cpu}, -Os" ${built}/libtopoadapt.a ${cross_size})
  if(NOT emulator)
    message("Cortex-M${cpu}: no qemu-arm")
    continue()
  endif()
  execute_process(COMMAND ${emulator} ${built}/tests/bench/digest/merge_digest OUTPUT_VARIABLE there
    RESULT_VARIABLE result)
  if(NOT result EQUAL 0 OR NOT here STREQUAL there)
    message(FATAL_ERROR "A merge in code for Cortex-M${cpu} (${result}):\n${there}here:\n${here}")
  endif()
  message("A merge in code for Cortex-M${cpu} has the digests of this machine")
endforeach()
