# SPDX-License-Identifier: MIT
# One version in the header, the packages and the changelog.
# cmake -DSOURCE=FOLDER -DVERSION=0.2.0 -P version_test.cmake
cmake_policy(VERSION 3.22)
string(REGEX MATCH "^([0-9]+)\\.([0-9]+)\\.([0-9]+)$" version "${VERSION}")
set(macros "MAJOR ${CMAKE_MATCH_1}" "MINOR ${CMAKE_MATCH_2}" "PATCH ${CMAKE_MATCH_3}")
set(failures "")

# expect FILE TEXT: is the text in the file?
function(expect file text)
  file(READ ${SOURCE}/${file} content)
  string(FIND "${content}" "${text}" place)
  if(place EQUAL -1)
    string(STRIP "${text}" text)
    set(failures "${failures}\n  ${file} has no \"${text}\"" PARENT_SCOPE)
  endif()
endfunction()

foreach(macro IN LISTS macros)
  expect(include/topoadapt.h "#define TPA_VERSION_${macro}\n")
endforeach()
foreach(file examples/rust/topoadapt/Cargo.toml examples/rust/topoadapt-sys/Cargo.toml examples/python/pyproject.toml)
  expect(${file} "\nversion = \"${VERSION}\"\n")
endforeach()
expect(examples/python/topoadapt/__init__.py "\n__version__ = \"${VERSION}\"\n")
foreach(file package.json topoadapt-wasm/package.json)
  expect(examples/web/${file} "\n  \"version\": \"${VERSION}\",\n")
endforeach()

# The newest section of the changelog.
file(STRINGS ${SOURCE}/CHANGELOG.md sections REGEX "^## ")
list(GET sections 0 newest)
if(NOT newest MATCHES "^## .${VERSION}. - ")
  string(APPEND failures "\n  CHANGELOG.md begins with \"${newest}\"")
endif()
if(failures)
  message(FATAL_ERROR "Not version ${VERSION}:${failures}")
endif()
