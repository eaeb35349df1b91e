# SPDX-License-Identifier: MIT
# Toolchain for Cortex-M: GCC for bare metal, newlib. CORTEX_M is 4 (no double-precision unit) or 7 (with one).
#   cmake -S . -B build/cortex_m -DCMAKE_TOOLCHAIN_FILE=cmake/cortex_m.cmake -DCORTEX_M=7
#     -DCMAKE_BUILD_TYPE=MinSizeRel -DTOPOADAPT_TOOL=OFF -DTOPOADAPT_TESTS=OFF
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CORTEX_M 4 CACHE STRING "4 or 7")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CORTEX_M)
if(NOT CORTEX_M MATCHES "^[47]$")
  message(FATAL_ERROR "CORTEX_M is 4 or 7, not ${CORTEX_M}")
endif()
set(cortex_m4 "-mcpu=cortex-m4 -mthumb -mfloat-abi=soft")
set(cortex_m7 "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16")
set(CMAKE_C_FLAGS_INIT "${cortex_m${CORTEX_M}} -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")
# Bare metal has no start-up code to link a test program with.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
