# SPDX-License-Identifier: MIT
# What a project gets that takes the sources, with add_subdirectory or FetchContent. Nothing here reaches that project.

# Without a build type CMake optimises nothing, and the kernels, written for inlining, take 29 times as long. Whoever wants
# that, to look for mistakes, asks for a build type: Debug.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES AND NOT CMAKE_CXX_FLAGS MATCHES "(^| )[-/]O")
  separate_arguments(boxstream_release_flags NATIVE_COMMAND "${CMAKE_CXX_FLAGS_RELEASE}")
  add_compile_options(${boxstream_release_flags})
  message(STATUS "boxstream: this project has no build type, so boxstream alone is optimised (${CMAKE_CXX_FLAGS_RELEASE}); \
-DCMAKE_BUILD_TYPE=Release optimises all of it")
endif()
