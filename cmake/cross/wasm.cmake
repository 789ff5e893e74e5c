# SPDX-License-Identifier: MIT
# Debian's Emscripten: WebAssembly with vectors of 128 bits and with exceptions of its own; programs run in Node.
# Pages have to load it, so small code comes first; src/CMakeLists.txt excepts what searches spend their time in. For
# Emscripten small means nothing inlined, which is neither small nor fast.
set(CMAKE_CXX_FLAGS_RELEASE "-Os -finline-functions -DNDEBUG" CACHE STRING "")
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
add_compile_options(-msimd128 -fwasm-exceptions -fno-pic -include ${CMAKE_CURRENT_LIST_DIR}/wasm/missing.hpp)
add_link_options(-fwasm-exceptions)
set(BOXSTREAM_HARDENED OFF CACHE BOOL "" FORCE)  # such code cannot reach its stack or other code by addresses
# Of Highway its headers are all that one SIMD target needs, without those of the system around them.
set(hwy_DIR ${CMAKE_CURRENT_LIST_DIR}/wasm)
