# SPDX-License-Identifier: MIT
# One target for the warnings of our own code; errors in CI only (-DBOXSTREAM_WERROR=ON).
option(BOXSTREAM_WERROR "Treat warnings as errors" OFF)
add_library(boxstream_warnings INTERFACE)
if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
  return()
endif()
target_compile_options(boxstream_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast -Wundef
  # GCC 12 sees overlapping copies in std::string assignments where there are none (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  # A shared unit (CMAKE_UNITY_BUILD) has names of other sources, and GCC takes its sources for headers.
  $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-shadow>
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wno-subobject-linkage>
  $<$<BOOL:${BOXSTREAM_WERROR}>:-Werror>)
