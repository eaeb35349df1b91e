# SPDX-License-Identifier: MIT
# The port for vcpkg with CMake's own commands in place of vcpkg's functions: static and shared, it installs one kind of
# library, against which the example of README builds and runs. Versions and options of both recipes are those of the project.
# cmake -DSOURCE= -DVERSION= -DTABLES=printer -DC= -DCXX= -DPYTHON= -DFOLDER= -P packaging_test.cmake
cmake_policy(VERSION 3.22)
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${output}${errors}")
  endif()
endfunction()

# ---------------------------------------------------------------- what vcpkg would bring

function(vcpkg_cmake_configure)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
  # Printed tables, and no optimization: minutes less.
  run(${CMAKE_COMMAND} -S ${arg_SOURCE_PATH} -B ${FOLDER}/build -DCMAKE_BUILD_TYPE=Debug -DCMAKE_UNITY_BUILD=ON
    -DCMAKE_C_COMPILER=${C} -DCMAKE_CXX_COMPILER=${CXX} -DBUILD_SHARED_LIBS=${shared} -DCMAKE_INSTALL_LIBDIR=lib
    -DCMAKE_INSTALL_PREFIX=${CURRENT_PACKAGES_DIR} -DTOPOADAPT_TABLES=${FOLDER}/tables.cpp ${arg_OPTIONS})
  foreach(option IN LISTS arg_OPTIONS)
    string(REGEX MATCH "-D(TOPOADAPT_[A-Z_]+)=" name "${option}")
    file(STRINGS ${arg_SOURCE_PATH}/CMakeLists.txt declared REGEX "^option\\(${CMAKE_MATCH_1} ")
    if(NOT declared)
      message(FATAL_ERROR "the port sets ${option}, which is no option")
    endif()
  endforeach()
endfunction()
function(vcpkg_cmake_install)
  run(${CMAKE_COMMAND} --build ${FOLDER}/build --parallel 2)
  run(${CMAKE_COMMAND} --install ${FOLDER}/build)
endfunction()
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "PACKAGE_NAME;CONFIG_PATH" "")
  if(NOT EXISTS ${CURRENT_PACKAGES_DIR}/${arg_CONFIG_PATH}/${arg_PACKAGE_NAME}-config.cmake)
    message(FATAL_ERROR "no CMake package in ${arg_CONFIG_PATH}")
  endif()
endfunction()
function(vcpkg_fixup_pkgconfig)
  if(NOT EXISTS ${CURRENT_PACKAGES_DIR}/lib/pkgconfig/topoadapt.pc)
    message(FATAL_ERROR "no file for pkg-config")
  endif()
endfunction()
function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "FILE_LIST")
  file(INSTALL ${arg_FILE_LIST} DESTINATION ${CURRENT_PACKAGES_DIR}/share/${PORT} MESSAGE_NEVER)
endfunction()

# ---------------------------------------------------------------- the port

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/program)
execute_process(COMMAND ${TABLES} OUTPUT_FILE ${FOLDER}/tables.cpp COMMAND_ERROR_IS_FATAL ANY)
file(WRITE ${FOLDER}/program/CMakeLists.txt "cmake_minimum_required(VERSION 3.22)\nproject(program C)\n"
  "find_package(topoadapt ${VERSION} EXACT REQUIRED)\nadd_executable(program ${SOURCE}/examples/minimal.c)\n"
  "target_link_libraries(program PRIVATE topoadapt::topoadapt)\n")
set(PORT topoadapt)
foreach(shared OFF ON)
  set(CURRENT_PACKAGES_DIR ${FOLDER}/packages_${shared})
  include(${SOURCE}/packaging/vcpkg/topoadapt/portfile.cmake)
  file(GLOB static ${CURRENT_PACKAGES_DIR}/lib/*.a)
  file(GLOB dynamic ${CURRENT_PACKAGES_DIR}/lib/*.so*)
  if((shared AND (static OR NOT dynamic)) OR (NOT shared AND (dynamic OR NOT static)))
    message(FATAL_ERROR "shared libraries ${shared}: installed are ${static} ${dynamic}")
  endif()
  foreach(file include/topoadapt.h include/topoadapt.hpp share/topoadapt/LICENSE share/topoadapt/usage)
    if(NOT EXISTS ${CURRENT_PACKAGES_DIR}/${file})
      message(FATAL_ERROR "the port installs no ${file}")
    endif()
  endforeach()
  run(${CMAKE_COMMAND} -S ${FOLDER}/program -B ${FOLDER}/program_${shared} -DCMAKE_C_COMPILER=${C}
    -DCMAKE_PREFIX_PATH=${CURRENT_PACKAGES_DIR})
  run(${CMAKE_COMMAND} --build ${FOLDER}/program_${shared})
  run(${FOLDER}/program_${shared}/program)
endforeach()
file(READ ${SOURCE}/packaging/vcpkg/topoadapt/vcpkg.json json)
string(JSON version GET "${json}" version)
if(NOT version STREQUAL VERSION)
  message(FATAL_ERROR "the port has version ${version}")
endif()

# ---------------------------------------------------------------- the recipe for Conan

if(PYTHON)
  run(${PYTHON} -B ${SOURCE}/tests/build/conan_recipe.py ${SOURCE} ${VERSION} ${FOLDER}/conan)
endif()
