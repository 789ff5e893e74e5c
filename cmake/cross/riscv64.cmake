# SPDX-License-Identifier: MIT
# Debian 12 has no packages of this system but for the compiler's own.
set(system riscv64)
set(triplet riscv64-linux-gnu)
set(CMAKE_SYSTEM_PROCESSOR riscv64)
include(${CMAKE_CURRENT_LIST_DIR}/linux.cmake)
set(CMAKE_EXE_LINKER_FLAGS_INIT -Wl,-rpath-link,/usr/${triplet}/lib)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-riscv64 -L /usr/${triplet})
