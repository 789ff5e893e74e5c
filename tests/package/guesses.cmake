# SPDX-License-Identifier: MIT
# Which component is meant by a name that none has.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_DIR}/adapters.cmake)
foreach(case IN ITEMS bulet/bullet bulllet/bullet bulelt/bullet bulket/bullet Bullet/bullet bullet-float64/bullet_float64
    bullet_float/bullet_float64 float/ FCL/fcl fc/fcl tbb2/tbb openmpi/ havok/ x/ code/core)
  string(REGEX MATCH "^(.*)/(.*)$" ignored ${case})
  set(given ${CMAKE_MATCH_1})
  set(meant "${CMAKE_MATCH_2}")
  if(meant)
    set(meant " (did you mean ${meant}?)")
  endif()
  boxstream_guess(guess ${given} core ${boxstream_adapters})
  if(NOT guess STREQUAL meant)
    message(SEND_ERROR "${given}: '${guess}' instead of '${meant}'")
  endif()
endforeach()
