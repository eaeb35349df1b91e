# SPDX-License-Identifier: MIT
# cmake -D SCENES=program -D EXPECTED=expected.txt -P compare.cmake
execute_process(COMMAND ${SCENES} OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
file(READ ${EXPECTED} expected)
if(NOT lines STREQUAL expected)
  message(FATAL_ERROR "The scenes have other results. If that is meant: ${SCENES} > ${EXPECTED}\n${lines}")
endif()
