# SPDX-License-Identifier: MIT
# cmake -D SOURCE=... -D ARCHIVE=... -D MINIMAL=... -D FOLDER=... -D BINDGEN=... -D RUSTC=... -P rust.cmake
# What bindgen makes of the header has the layouts that a C compiler gives it, as bindgen's own tests say, and the
# example in Rust prints what the one in C does.
function(run output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${text}${errors}")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

file(MAKE_DIRECTORY ${FOLDER})
set(bindings ${FOLDER}/topoadapt.rs)
run(ignored ${BINDGEN} ${SOURCE}/include/topoadapt.h --allowlist-function tpa_.* --allowlist-type tpa_.*
  --allowlist-var TPA_.* --no-prepend-enum-name --output ${bindings})

# Every constant of the header is there.
file(STRINGS ${SOURCE}/include/topoadapt.h header REGEX "TPA_[A-Z0-9_]+ (= )?-?[0-9]")
file(READ ${bindings} text)
set(constant_count 0)
foreach(line IN LISTS header)
  string(REGEX REPLACE "/?\\*.*" "" code "${line}")  # up to a comment
  string(REGEX MATCHALL "TPA_[A-Z0-9_]+ (= )?-?[0-9]" constants "${code}")
  foreach(match IN LISTS constants)
    string(REGEX REPLACE " .*" "" constant "${match}")
    math(EXPR constant_count "${constant_count} + 1")
    if(NOT text MATCHES "pub const ${constant}: ")
      message(FATAL_ERROR "bindgen drops ${constant}")
    endif()
  endforeach()
endforeach()
if(constant_count LESS 55 OR NOT text MATCHES "pub const TPA_NONE: u32 = 4294967295;")
  message(FATAL_ERROR "${constant_count} constants, and TPA_NONE, not read as expected")
endif()
run(ignored ${RUSTC} --edition 2021 --test -A warnings ${bindings} -o ${FOLDER}/layouts)
run(layouts ${FOLDER}/layouts)
# Since bindgen 0.70 they are assertions, which the compiler has looked at.
file(STRINGS ${bindings} assertions REGEX "^const _: \\(\\) = |Size of tpa_")
if(NOT layouts MATCHES "test result: ok. [1-9][0-9]* passed" AND NOT assertions MATCHES "const _.*Size of tpa_")
  message(FATAL_ERROR "no layout was tested:\n${layouts}")
endif()

get_filename_component(archive_folder ${ARCHIVE} DIRECTORY)
run(ignored ${CMAKE_COMMAND} -E env TOPOADAPT_BINDINGS=${bindings} ${RUSTC} --edition 2021 -D warnings
  ${SOURCE}/examples/minimal.rs -L ${archive_folder} -l static=topoadapt -o ${FOLDER}/minimal)
run(of_rust ${FOLDER}/minimal)
run(of_c ${MINIMAL})
if(NOT of_rust STREQUAL of_c)
  message(FATAL_ERROR "${of_rust}differs from\n${of_c}")
endif()
