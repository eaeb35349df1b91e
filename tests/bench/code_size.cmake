# cmake -D SOURCE=... -D BINARY=... -D ARCHIVE=... -D SIZE=... -D NM=... -D DIGEST=... -P code_size.cmake
# Prints the code and constants of the library beside the handle tables: as built here, and linked for Cortex-M at -Os
# with all functions of the interface, where there is a compiler for it; and runs a merge in that code, where there is
# QEMU, whose digests must be those of here.

# Tables of handles that are no files of their own.
set(small_tables "3tpa(9exchanges|10turn_rules|5plans)E")

# `small`: those of the tables that are counted with the code.
function(print_size what goal code tables small)
  math(EXPR code "${code} - ${small}")
  math(EXPR tables "${tables} + ${small}")
  math(EXPR kib "(${code} + 512) / 1024")
  message("${what}: ${code} bytes (${kib} KiB; goal ${goal} KiB) beside ${tables} bytes of handle tables, ${small} of "
    "them in other files")
endfunction()

# The bytes of tables among the symbols of a file or an archive.
function(measure_small_tables nm file result)
  execute_process(COMMAND ${nm} --print-size --radix=d ${file} OUTPUT_VARIABLE symbols ERROR_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[0-9]+ [0-9]+ [a-zA-Z] _ZN${small_tables}" lines "${symbols}")
  set(sum 0)
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^[0-9]+ 0*([0-9]+) .*" "\\1" bytes "${line}")
    math(EXPR sum "${sum} + ${bytes}")
  endforeach()
  set(${result} ${sum} PARENT_SCOPE)
endfunction()

# Code and constants of the objects in an archive whose names match, and of the others.
function(measure_archive archive size_tool pattern matching others)
  execute_process(COMMAND ${size_tool} ${archive} OUTPUT_VARIABLE sizes COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${sizes}")
  set(${matching} 0)
  set(${others} 0)
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "^ *([0-9]+)[ \t]+([0-9]+)[ \t]+[0-9]+[ \t]+[0-9]+[ \t]+[0-9a-f]+[ \t]+([^ ]+)")
      continue()
    endif()
    math(EXPR bytes "${CMAKE_MATCH_1} + ${CMAKE_MATCH_2}")
    if(CMAKE_MATCH_3 MATCHES "${pattern}")
      math(EXPR ${matching} "${${matching}} + ${bytes}")
    else()
      math(EXPR ${others} "${${others}} + ${bytes}")
    endif()
  endforeach()
  set(${matching} ${${matching}} PARENT_SCOPE)
  set(${others} ${${others}} PARENT_SCOPE)
endfunction()

measure_archive(${ARCHIVE} ${SIZE} "^handle_table" tables code)
measure_small_tables(${NM} ${ARCHIVE} small)
print_size("This machine" 256 ${code} ${tables} ${small})

find_program(cross_compiler arm-none-eabi-g++)
find_program(cross_size arm-none-eabi-size)
find_program(cross_nm arm-none-eabi-nm)
find_program(emulator qemu-arm)
if(NOT cross_compiler OR NOT cross_size OR NOT cross_nm)
  message("Cortex-M: no arm-none-eabi-g++")
  return()
endif()

# Every function of the interface, as the linker is asked to keep it.
file(STRINGS ${SOURCE}/include/topoadapt.h declarations REGEX "tpa_[A-Za-z0-9_]+\\(")
string(REGEX MATCHALL "tpa_[A-Za-z0-9_]+\\(" functions "${declarations}")
list(TRANSFORM functions REPLACE "(.*)\\(" "-Wl,-u,\\1")
list(REMOVE_DUPLICATES functions)

execute_process(COMMAND ${DIGEST} OUTPUT_VARIABLE here COMMAND_ERROR_IS_FATAL ANY)
foreach(cpu 4 7)
  set(CORTEX_M ${cpu})
  include(${SOURCE}/cmake/cortex_m.cmake)
  set(name "Cortex-M${cpu}")
  set(built ${BINARY}${cpu})
  execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${built}
    -D CMAKE_TOOLCHAIN_FILE=${SOURCE}/cmake/cortex_m.cmake -D CORTEX_M=${cpu} -D CMAKE_BUILD_TYPE=MinSizeRel
    -D TOPOADAPT_TOOL=OFF -D TOPOADAPT_TESTS=OFF -D TOPOADAPT_DIGEST=ON OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${CMAKE_COMMAND} --build ${built} --target merge_digest -j2 OUTPUT_QUIET
    COMMAND_ERROR_IS_FATAL ANY)
  # Without the handle tables, and without the compiler's library and newlib, which are not ours to count.
  set(objects ${built}/CMakeFiles/topoadapt_objects.dir/src)
  file(GLOB others ${objects}/*.obj)
  file(GLOB table_objects ${objects}/handle_table*.obj)
  list(REMOVE_ITEM others ${table_objects})
  execute_process(COMMAND ${cross_compiler} ${cortex_m${cpu}} -Os -flto -flto-partition=one -nostdlib -nostartfiles
    ${functions} -Wl,--gc-sections,-e,tpa_step,--unresolved-symbols=ignore-all ${others} -o ${built}/library.elf
    COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${cross_compiler} ${cortex_m${cpu}} -Os -flto -flto-partition=one -r
    -flinker-output=nolto-rel ${table_objects} -nostdlib -o ${built}/tables.o COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND ${cross_nm} ${built}/library.elf OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  foreach(function IN LISTS functions)
    string(REGEX REPLACE ".*," "" function ${function})
    if(NOT symbols MATCHES " T ${function}\n")
      message(FATAL_ERROR "${name}: ${function} is not in the image")
    endif()
  endforeach()
  measure_archive(${built}/library.elf ${cross_size} "^none" unused code)
  measure_archive(${built}/tables.o ${cross_size} "^none" unused tables)
  measure_small_tables(${cross_nm} ${built}/library.elf small)
  print_size("${name}, -Os" 160 ${code} ${tables} ${small})
  if(NOT emulator)
    message("${name}: no qemu-arm")
    continue()
  endif()
  execute_process(COMMAND ${emulator} ${built}/tests/bench/digest/merge_digest OUTPUT_VARIABLE there RESULT_VARIABLE result)
  if(NOT result EQUAL 0 OR NOT here STREQUAL there)
    message(FATAL_ERROR "A merge in code for ${name} (${result}):\n${there}here:\n${here}")
  endif()
  message("A merge in code for ${name} has the digests of this machine")
endforeach()
