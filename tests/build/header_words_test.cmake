# SPDX-License-Identifier: MIT
# The public header says what a caller has to know, and no more: at most 100 words of comment a function in the mean, and
# at most 25 lines before the first line of code. The count is first tried on a header with a known answer.
# cmake -DHEADER=topoadapt.h -P header_words_test.cmake
cmake_policy(VERSION 3.22)

set(most_words 100)
set(most_lines 25)

# count(TEXT WORDS FUNCTIONS LINES): of comments; that are exported; before the first line of code.
function(count text words functions lines)
  string(REGEX REPLACE "[][;]" "," text "${text}")
  string(REGEX MATCHALL "/[*][^*]*[*]+([^/*][^*]*[*]+)*/" comments "${text}")
  string(REGEX MATCHALL "[^ \n;]*[A-Za-z0-9][^ \n;]*" found "${comments}")
  list(LENGTH found number)
  set(${words} ${number} PARENT_SCOPE)
  string(REGEX MATCHALL "\nTPA_API " found "${text}")
  list(LENGTH found number)
  set(${functions} ${number} PARENT_SCOPE)
  string(REGEX MATCH "^((/[*]| [*])[^\n]*\n|\n)*" head "${text}")
  string(REGEX MATCHALL "\n" found "${head}")
  list(LENGTH found number)
  set(${lines} ${number} PARENT_SCOPE)
endfunction()

count("/* A licence */\n/* one two\n * three [4]; - x * five\n */\n#ifndef A\n/* six */\nTPA_API int f(void);\n\nTPA_API int g(int); /* 7 */\n"
  words functions lines)
if(NOT "${words} ${functions} ${lines}" STREQUAL "10 2 4")
  message(FATAL_ERROR "the count is wrong: ${words} words, ${functions} functions, ${lines} lines")
endif()

file(READ ${HEADER} text)
count("${text}" words functions lines)
if(functions EQUAL 0)
  message(FATAL_ERROR "no function found in ${HEADER}")
endif()
math(EXPR mean "(${words} + ${functions} - 1) / ${functions}")
message(STATUS "${words} words for ${functions} functions, ${mean} each; ${lines} lines before the first line of code")
if(mean GREATER most_words)
  message(FATAL_ERROR "${mean} words a function, at most ${most_words}: say what a caller has to know; the guide says why")
endif()
if(lines GREATER most_lines)
  message(FATAL_ERROR "${lines} lines before the first line of code, at most ${most_lines}")
endif()
