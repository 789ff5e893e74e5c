# SPDX-License-Identifier: MIT
# The lines of docs/build.md for FetchContent, in a project without a build type.
readme_block(fetchcontent lines)
set(fetched ${CMAKE_CURRENT_BINARY_DIR}/fetched)
file(CONFIGURE OUTPUT ${fetched}/CMakeLists.txt @ONLY CONTENT [[
cmake_minimum_required(VERSION 3.25)
project(fetched LANGUAGES CXX)
add_executable(your_program ${CORE_PROGRAM})
@lines@]])
add_test(NAME package.fetched COMMAND ${CMAKE_COMMAND} -DSOURCE=${fetched} -DBUILD=${fetched}/build
  -DBOXSTREAM=${PROJECT_SOURCE_DIR} -DCORE_PROGRAM=${CMAKE_CURRENT_SOURCE_DIR}/consumer/core.cpp
  -DCXX=${CMAKE_CXX_COMPILER} -P ${CMAKE_CURRENT_SOURCE_DIR}/fetched_run.cmake)
set_tests_properties(package.fetched PROPERTIES LABELS package)
