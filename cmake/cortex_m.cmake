# Toolchain for Cortex-M4 without its floating-point unit, which has no doubles: GCC for bare metal, newlib.
#   cmake -S . -B build/cortex_m -DCMAKE_TOOLCHAIN_FILE=cmake/cortex_m.cmake -DCMAKE_BUILD_TYPE=MinSizeRel
#     -DTOPOADAPT_TOOL=OFF -DTOPOADAPT_TESTS=OFF
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_C_FLAGS_INIT "-mcpu=cortex-m4 -mthumb -mfloat-abi=soft -ffunction-sections -fdata-sections")
set(CMAKE_CXX_FLAGS_INIT "${CMAKE_C_FLAGS_INIT}")
# There is nothing to link a test program against.
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
