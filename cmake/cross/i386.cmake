# SPDX-License-Identifier: MIT
# 32-bit x86, which this machine's processor runs itself, with the loader and the libraries of that system.
set(system i386)
set(triplet i686-linux-gnu)
set(CMAKE_SYSTEM_PROCESSOR i686)
include(${CMAKE_CURRENT_LIST_DIR}/linux.cmake)
set(CMAKE_LIBRARY_ARCHITECTURE i386-linux-gnu)
set(CMAKE_CXX_FLAGS_INIT "-msse2 -mfpmath=sse")  # tests compute what contracts say, without excess precision
set(CMAKE_CROSSCOMPILING_EMULATOR ${root}/lib/ld-linux.so.2
  --library-path ${root}/lib/i386-linux-gnu:${root}/usr/lib/i386-linux-gnu)
