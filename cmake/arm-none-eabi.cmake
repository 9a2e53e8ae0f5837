# Toolchain file for a bare Cortex-M3 with Debian's gcc-arm-none-eabi (and libstdc++-arm-none-eabi-dev for its headers; no
# library is linked but libgcc):
#
#   cmake -S examples/05_cortex_m3 -B build --toolchain cmake/arm-none-eabi.cmake
#
# WAYMARK_MCU names another processor: -DWAYMARK_MCU=cortex-m0plus
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)   # nothing can be linked before there is a linker script
set(WAYMARK_MCU cortex-m3 CACHE STRING "The processor, as in -mcpu=")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES WAYMARK_MCU)

# -fno-move-loop-invariants: what is hoisted out of a loop takes registers, and these take stack and code.
string(CONCAT CMAKE_CXX_FLAGS_INIT
  "-mcpu=${WAYMARK_MCU} -mthumb -ffreestanding -fno-exceptions -fno-rtti -fno-threadsafe-statics "
  "-ffunction-sections -fdata-sections -fno-move-loop-invariants")
set(CMAKE_CXX_FLAGS_RELEASE_INIT "-Os")
set(CMAKE_CXX_FLAGS_RELEASE "-Os" CACHE STRING "Smallest code")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostdlib -Wl,--gc-sections")

# Programs of this machine, libraries and headers of the target.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
