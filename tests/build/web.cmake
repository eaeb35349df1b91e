# SPDX-License-Identifier: MIT
# cmake -D SOURCE=... -D FOLDER=... -D MODULES=... -D ARCHIVE=... -D TABLES=... -D NPM=... -D BASH=... -P web.cmake
# Both modules, in the folder MODULES, and the page of examples/web are built and pass their tests, in a copy: node_modules
# stays for the next run.
# TABLES: printed handle tables, or empty, and the tables come from ARCHIVE. The page is not tried without Chromium.
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${FOLDER}/web RESULT_VARIABLE status OUTPUT_VARIABLE text
    ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${text}${errors}")
  endif()
  set(text "${text}" PARENT_SCOPE)
endfunction()

file(COPY ${SOURCE}/examples/web DESTINATION ${FOLDER} PATTERN node_modules EXCLUDE PATTERN dist EXCLUDE
  PATTERN "*.wasm" EXCLUDE)
if(NOT TABLES)
  set(ENV{TOPOADAPT_ARCHIVE} ${ARCHIVE})
  set(ENV{TOPOADAPT_PORTABILITY} ${FOLDER}/portability)
  run(${BASH} ${SOURCE}/tests/portability/run.sh --tables)
  string(STRIP "${text}" TABLES)
endif()
set(ENV{TOPOADAPT_TABLES} ${TABLES})
set(ENV{TOPOADAPT_INCLUDE} ${SOURCE}/include)
file(MAKE_DIRECTORY ${MODULES})
run(${BASH} ${SOURCE}/examples/web/build-wasm.sh ${MODULES}/topoadapt.wasm)
file(COPY ${MODULES}/topoadapt.wasm ${MODULES}/topoadapt-threads.wasm DESTINATION ${FOLDER}/web/topoadapt-wasm)

set(lock ${FOLDER}/web/package-lock.json)
set(installed ${FOLDER}/web/node_modules/package-lock.json)
execute_process(COMMAND ${CMAKE_COMMAND} -E compare_files ${lock} ${installed} RESULT_VARIABLE differs ERROR_QUIET)
if(NOT differs EQUAL 0)
  # From the cache of npm alone, else with the registry's help.
  set(ci ${NPM} ci --no-audit --no-fund)
  execute_process(COMMAND ${ci} --offline WORKING_DIRECTORY ${FOLDER}/web RESULT_VARIABLE status OUTPUT_QUIET ERROR_QUIET)
  if(NOT status EQUAL 0)
    execute_process(COMMAND ${NPM} ping --fetch-retries=1 --fetch-timeout=60000 RESULT_VARIABLE status OUTPUT_QUIET
      ERROR_QUIET)
    if(NOT status EQUAL 0)
      message("skipped: no registry of npm")
      return()
    endif()
    run(${ci} --prefer-offline)
  endif()
  file(COPY ${lock} DESTINATION ${FOLDER}/web/node_modules)
endif()
run(${NPM} run build)
run(${NPM} test)
message("${text}")
if(text MATCHES "# SKIP no topoadapt-threads")
  message(FATAL_ERROR "threads were not tried")
endif()
