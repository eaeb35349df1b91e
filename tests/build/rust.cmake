# SPDX-License-Identifier: MIT
# cmake -D SOURCE=... -D BUILD=... -D ARCHIVE=... -D MINIMAL=... -D FOLDER=... -D CARGO=... -D REGISTRY=... -D PKG_CONFIG=... -P rust.cmake
# The crates of examples/rust pass their tests, and their minimal example prints what the one in C does: with an
# installed library that pkg-config finds, where there is a pkg-config.
function(run output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${text}${errors}")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

# The crate cc from Debian's folder of crates.
file(WRITE ${FOLDER}/registry.toml "[source.crates-io]\nreplace-with = \"debian\"\n[source.debian]\ndirectory = \"${REGISTRY}\"\n")
set(options --offline --locked --config ${FOLDER}/registry.toml --manifest-path ${SOURCE}/examples/rust/Cargo.toml)
get_filename_component(library_folder ${ARCHIVE} DIRECTORY)
set(ENV{TOPOADAPT_LIB_DIR} ${library_folder})
run(tests ${CARGO} test ${options} --target-dir ${FOLDER}/tests -- --show-output)
message("${tests}")
string(REGEX MATCHALL "test result: ok. [1-9][0-9]* passed" passed "${tests}")
list(LENGTH passed passed_count)
if(passed_count LESS 4)  # unit tests, integration tests, bindings, documentation
  message(FATAL_ERROR "some tests were not run")
endif()

run(ignored ${CARGO} check ${options} --target-dir ${FOLDER}/tests --package topoadapt --no-default-features)

if(PKG_CONFIG)
  run(ignored ${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/installed)
  file(GLOB_RECURSE description ${FOLDER}/installed/topoadapt.pc)
  get_filename_component(description_folder ${description} DIRECTORY)
  unset(ENV{TOPOADAPT_LIB_DIR})
  set(ENV{PKG_CONFIG} ${PKG_CONFIG})
  set(ENV{PKG_CONFIG_PATH} ${description_folder})
endif()
run(of_rust ${CARGO} run --quiet ${options} --target-dir ${FOLDER}/installed_target --package topoadapt --example minimal)
run(of_c ${MINIMAL})
if(NOT of_rust STREQUAL of_c)
  message(FATAL_ERROR "${of_rust}differs from\n${of_c}")
endif()
