# SPDX-License-Identifier: MIT
# What the libraries themselves need. Found here, at the top, so that the imported targets are visible to every
# directory that links one of the libraries. The installed package repeats these look-ups: boxstream-config.cmake.in.
find_package(hwy 1.0 CONFIG QUIET)
if(NOT hwy_FOUND)
  message(FATAL_ERROR "boxstream needs Highway: install libhwy-dev (./dev setup installs all packages)")
endif()

find_package(TBB CONFIG QUIET)
if(NOT TBB_FOUND)
  message(STATUS "boxstream: oneTBB is not found, target boxstream::tbb is left out")
endif()

# Configs rather than modules: CGAL brings a module for Eigen that makes no target.
find_package(Eigen3 CONFIG QUIET)
find_package(ccd CONFIG QUIET)
if(NOT TARGET Eigen3::Eigen OR NOT TARGET ccd)
  message(STATUS "boxstream: Eigen or libccd is not found, target boxstream::ccd is left out")
endif()

if(NOT BOXSTREAM_BULLET)
  message(STATUS "boxstream: Bullet adapter switched off")
else()
  include(cmake/find_bullet.cmake)
  set(missing "")
  foreach(component IN ITEMS bullet bullet_float64)
    boxstream_find_bullet(reason ${component})
    if(reason)
      message(STATUS "boxstream: adapter target boxstream::${component} is left out: ${reason}")
      list(APPEND missing ${component})
    endif()
  endforeach()
  # A project that brings its own Bullet has one precision of it.
  boxstream_own_bullet(own_bullet)
  list(LENGTH missing missing_count)
  if(NOT BOXSTREAM_BULLET STREQUAL "AUTO" AND missing AND (missing_count EQUAL 2 OR NOT own_bullet))
    message(FATAL_ERROR "BOXSTREAM_BULLET is ON, but Bullet is not found for ${missing}: install libbullet-dev and \
pkg-config, or name Bullet's targets in BOXSTREAM_BULLET_TARGET")
  endif()
endif()

if(NOT BOXSTREAM_FCL)
  message(STATUS "boxstream: FCL adapter switched off")
else()
  # FCL's config names Eigen's target without looking for its config: a find module on the way would hide it.
  find_package(Eigen3 CONFIG QUIET)
  if(TARGET Eigen3::Eigen)
    find_package(fcl CONFIG QUIET)
  endif()
  if(NOT TARGET fcl)
    if(NOT BOXSTREAM_FCL STREQUAL "AUTO")
      message(FATAL_ERROR "BOXSTREAM_FCL is ON, but FCL's CMake package fcl is not found: install libfcl-dev")
    endif()
    message(STATUS "boxstream: FCL is not found, target boxstream::fcl is left out")
  endif()
endif()
