# Toolchain for Cortex-M: GCC for bare metal, newlib. CORTEX_M: 4, without its floating-point unit, which has no doubles;
# or 7, with one that has.
#   cmake -S . -B build/cortex_m -DCMAKE_TOOLCHAIN_FILE=cmake/cortex_m.cmake -DCORTEX_M=7
#     -DCMAKE_BUILD_TYPE=MinSizeRel -DTOPOADAPT_TOOL=OFF -DTOPOADAPT_TESTS=OFF
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
# The archive holds what the link-time optimizer reads: a program gets what it calls, and of what files share one copy.
set(CMAKE_AR arm-none-eabi-gcc-ar)
set(CMAKE_RANLIB arm-none-eabi-gcc-ranlib)
set(CORTEX_M 4 CACHE STRING "4 or 7")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES CORTEX_M)
if(NOT CORTEX_M MATCHES "^[47]$")
  message(FATAL_ERROR "CORTEX_M is 4 or 7, not ${CORTEX_M}")
endif()
set(cortex_m4 -mcpu=cortex-m4 -mthumb -mfloat-abi=soft)
set(cortex_m7 -mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16)
list(JOIN cortex_m${CORTEX_M} " " CMAKE_C_FLAGS_INIT)
string(APPEND CMAKE_C_FLAGS_INIT " -flto -flto-partition=one -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")
# What is moved out of loops, or apart from what uses it, or lies in registers across calls, takes more code to save them;
# what -Os does to the order of blocks takes more jumps, and what it learns from jumps copies blocks. Addresses that are
# carried forward are worked out more often; ends of blocks are merged better after all else than before. Calls of small
# functions are shorter than these where there are no doubles; arguments that are taken apart, common subexpressions that
# are sought once more, and common bases of addresses keep more registers busy than they save.
set(CMAKE_C_FLAGS_MINSIZEREL_INIT "-fno-tree-loop-im -fno-move-loop-invariants -fno-schedule-insns2 -fno-caller-saves \
-fno-reorder-blocks -fno-tree-dominator-opts -fno-forward-propagate -fno-tree-tail-merge -fno-tree-scev-cprop \
-fno-inline-small-functions -fno-ipa-sra -fno-expensive-optimizations -fno-section-anchors -fno-tree-phiprop \
-flive-range-shrinkage")
set(CMAKE_CXX_FLAGS_MINSIZEREL_INIT "${CMAKE_C_FLAGS_MINSIZEREL_INIT}")
# There is nothing to link a test program against.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
