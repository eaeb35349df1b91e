# SPDX-License-Identifier: MIT
# cmake -DSOURCE=folder -DTOOL=topoadapt -P formats_test.cmake
# The table of formats in docs/guide.md is the one made here from the texts of --help.
function(formats command line out)
  execute_process(COMMAND ${TOOL} ${command} --help OUTPUT_VARIABLE help RESULT_VARIABLE code)
  if(NOT code EQUAL 0 OR NOT help MATCHES "\n  ${line} +([^\n]*)")
    message(FATAL_ERROR "topoadapt ${command} --help has no line '${line}'")
  endif()
  string(REGEX MATCHALL "[.][a-z][a-z0-9.]*[a-z0-9]" words "${CMAKE_MATCH_1}")
  string(REPLACE ";" "`, `" words "${words}")
  set(${out} "`${words}`" PARENT_SCOPE)
endfunction()
formats(segment VOLUME volumes)
formats(segment "--mask F" masks)
formats(detect MESH meshes)
formats(resolve "--out M" outputs)
set(table "| files | formats |
|---|---|
| volumes read | ${volumes}, a folder of DICOM slices |
| masks written | ${masks} |
| meshes read | ${meshes} |
| meshes written | ${outputs} |
")
file(READ ${SOURCE}/docs/guide.md guide)
string(FIND "${guide}" "${table}" at)
if(at EQUAL -1)
  message(FATAL_ERROR "docs/guide.md should have the table\n${table}")
endif()
