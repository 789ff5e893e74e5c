# SPDX-License-Identifier: MIT
# What the libraries themselves need. Found here, at the top, so that the imported targets are visible to every
# directory that links one of the libraries. The installed package repeats these look-ups: boxstream-config.cmake.in.
find_package(hwy 1.0 CONFIG QUIET)
if(NOT hwy_FOUND)
  message(FATAL_ERROR "boxstream needs Highway: install libhwy-dev (./dev setup installs all packages)")
endif()

set(boxstream_built_adapters "")
foreach(component IN LISTS boxstream_adapters)
  string(TOUPPER BOXSTREAM_${boxstream_${component}_FOLDER} option)
  if(NOT ${option})
    boxstream_part("${component}" off ": switched off")
    continue()
  endif()
  boxstream_find_adapter(reason ${component})
  if(NOT reason)
    boxstream_part("${component}" on)
    list(APPEND boxstream_built_adapters ${component})
  # A project that brings its own Bullet has one precision of it.
  elseif(NOT ${option} STREQUAL "AUTO" AND NOT reason MATCHES "^the Bullet of this project")
    message(FATAL_ERROR "${option} is ON: ${reason}")
  else()
    boxstream_part("${component}" off ": ${reason}")
  endif()
endforeach()
