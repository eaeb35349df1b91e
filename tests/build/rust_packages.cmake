# SPDX-License-Identifier: MIT
# cmake -D SOURCE=... -D BUILD=... -D MINIMAL=... -D FOLDER=... -D CARGO=... -D REGISTRY=... -P rust_packages.cmake
# The packages of examples/rust/package.sh: a program in an empty folder depends on topoadapt as on any crate, and prints
# what the one in C does; the tests in the package pass. No installed library is named.
cmake_policy(VERSION 3.22)
function(run output folder)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${folder} RESULT_VARIABLE status OUTPUT_VARIABLE text
    ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${text}${errors}")
  endif()
  set(${output} "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/program/src)
unset(ENV{TOPOADAPT_LIB_DIR})
set(ENV{PKG_CONFIG} false)
set(ENV{TOPOADAPT_CARGO_REGISTRY} ${REGISTRY})
set(ENV{CARGO_TARGET_DIR} ${FOLDER}/target)
run(ignored ${FOLDER} ${CMAKE_COMMAND} --build ${BUILD} --target amalgamation)
run(ignored ${FOLDER} ${SOURCE}/examples/rust/package.sh ${FOLDER}/out ${BUILD}/amalgamation --no-verify)
foreach(crate topoadapt topoadapt-sys)
  file(GLOB package ${FOLDER}/out/${crate}-[0-9]*.crate)
  file(SIZE ${package} bytes)
  message("${package}: ${bytes} bytes")
  if(bytes GREATER 10485760)  # the limit of crates.io
    message(FATAL_ERROR "too large")
  endif()
endforeach()

set(options --offline --config ${FOLDER}/out/registry.toml)
file(WRITE ${FOLDER}/program/Cargo.toml
  "[package]\nname = \"program\"\nversion = \"1.0.0\"\nedition = \"2021\"\n[dependencies]\ntopoadapt = \"0\"\n")
file(COPY_FILE ${SOURCE}/examples/rust/topoadapt/examples/minimal.rs ${FOLDER}/program/src/main.rs)
run(of_rust ${FOLDER}/program ${CARGO} run --quiet ${options})
run(of_c ${FOLDER} ${MINIMAL})
if(NOT of_rust STREQUAL of_c)
  message(FATAL_ERROR "${of_rust}differs from\n${of_c}")
endif()

file(GLOB unpacked ${FOLDER}/out/registry/topoadapt-[0-9]*)
file(COPY ${unpacked}/ DESTINATION ${FOLDER}/unpacked)
run(tests ${FOLDER}/unpacked ${CARGO} test ${options})
string(REGEX MATCHALL "test result: ok. [1-9][0-9]* passed" passed "${tests}")
list(LENGTH passed passed_count)
if(passed_count LESS 3)  # unit tests, integration tests, documentation
  message(FATAL_ERROR "some tests were not run\n${tests}")
endif()
