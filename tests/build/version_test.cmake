# SPDX-License-Identifier: MIT
# One version in the header, the packages and the changelog: its newest section has this version, or is [Unreleased] above
# that of an older one.
# cmake -DSOURCE=FOLDER -DVERSION=0.3.0 -P version_test.cmake
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
string(REPLACE "." ", " tuple "${VERSION}")
expect(examples/blender/topoadapt_blender/__init__.py "\"version\": (${tuple}),\n")
expect(examples/blender/topoadapt_blender/blender_manifest.toml "\nversion = \"${VERSION}\"\n")
expect(examples/rust/topoadapt/Cargo.toml "version = \"=${VERSION}\" }\n")
expect(examples/python/topoadapt/__init__.py "\n__version__ = \"${VERSION}\"\n")
foreach(file package.json topoadapt-wasm/package.json)
  expect(examples/web/${file} "\n  \"version\": \"${VERSION}\",\n")
endforeach()

expect(packaging/vcpkg/topoadapt/vcpkg.json "\n  \"version\": \"${VERSION}\",\n")
expect(packaging/conan/conanfile.py "\n    version = \"${VERSION}\"\n")

# The newest section of the changelog.
file(STRINGS ${SOURCE}/CHANGELOG.md sections REGEX "^## ")
list(GET sections 0 newest)
if(newest STREQUAL "## [Unreleased]")
  list(GET sections 1 released)
  if(NOT released MATCHES "^## .([0-9.]+). - [0-9-]+$" OR CMAKE_MATCH_1 VERSION_GREATER VERSION)
    string(APPEND failures "\n  CHANGELOG.md has \"${released}\" below [Unreleased]")
  endif()
elseif(NOT newest MATCHES "^## .${VERSION}. - ")
  string(APPEND failures "\n  CHANGELOG.md begins with \"${newest}\"")
endif()
if(failures)
  message(FATAL_ERROR "Not version ${VERSION}:${failures}")
endif()
