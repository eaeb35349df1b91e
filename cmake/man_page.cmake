# SPDX-License-Identifier: MIT
# Writes the manual page of the tool from the texts of --help.
# cmake -DTOOL=topoadapt -DVERSION=0.3.0 -DOUT=topoadapt.1 -P man_page.cmake
cmake_policy(VERSION 3.22)

function(help out)
  execute_process(COMMAND ${TOOL} ${ARGN} --help OUTPUT_VARIABLE text RESULT_VARIABLE status)
  if(NOT status EQUAL 0 OR text STREQUAL "")
    message(FATAL_ERROR "${TOOL} ${ARGN} --help: ${status}")
  endif()
  # As in roff: backslashes and hyphens escaped, and no line begins with a dot or a quote.
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

help(all)
string(REGEX MATCHALL "\n  [a-z]+ " commands "${all}")
set(page ".TH TOPOADAPT 1 \"\" \"topoadapt ${VERSION}\"
.SH NAME
topoadapt \\- topology changes of triangle meshes, and segmentation of images
.SH SYNOPSIS
.nf
${all}.fi
")
foreach(command IN LISTS commands)
  string(STRIP "${command}" command)
  help(text ${command})
  string(TOUPPER ${command} title)
  string(APPEND page ".SH ${title}\n.nf\n${text}.fi\n")
endforeach()
file(WRITE ${OUT} "${page}")
