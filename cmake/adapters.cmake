# SPDX-License-Identifier: MIT
# The adapters: one table for the build, its options, the installation and the installed package.

# boxstream_adapter(<component> FOLDER <of adapters> ABOUT <text> NEEDS <text>
#   [PACKAGES <package> <its target>...] [REQUIRES <modules of pkg-config>])
# The option is BOXSTREAM_ and the folder's name. For Bullet find_bullet.cmake does the search.
set(boxstream_adapters "")
macro(boxstream_adapter component)
  list(APPEND boxstream_adapters ${component})
  cmake_parse_arguments(boxstream_${component} "" "FOLDER;ABOUT;NEEDS;REQUIRES" "PACKAGES" ${ARGN})
endmacro()

boxstream_adapter(bullet FOLDER bullet ABOUT "boxstream as the broad-phase of Bullet, single precision")
boxstream_adapter(bullet_float64 FOLDER bullet ABOUT "boxstream as the broad-phase of Bullet, double precision")
boxstream_adapter(c FOLDER c ABOUT "boxstream for C, and for languages that call C")
boxstream_adapter(ccd FOLDER ccd ABOUT "boxstream with a narrow phase for convex shapes on libccd"
  NEEDS "libccd and Eigen, and their CMake packages (Debian: libccd-dev libeigen3-dev)"
  PACKAGES Eigen3 Eigen3::Eigen ccd ccd REQUIRES "eigen3, ccd")
boxstream_adapter(coal FOLDER coal ABOUT "boxstream as the broad-phase of Coal, the successor of FCL"
  NEEDS "Coal 3, or hpp-fcl 2.4, as it was called before, and its CMake package" PACKAGES coal coal::coal REQUIRES coal)
# FCL's config names Eigen's target without looking for it.
boxstream_adapter(fcl FOLDER fcl ABOUT "boxstream as the broad-phase of FCL"
  NEEDS "FCL and Eigen, and their CMake packages (Debian: libfcl-dev libeigen3-dev)"
  PACKAGES Eigen3 Eigen3::Eigen fcl fcl REQUIRES fcl)
boxstream_adapter(mpi FOLDER mpi ABOUT "boxstream on many machines, over MPI"
  NEEDS "MPI for C++ (Debian: libopenmpi-dev or libmpich-dev)" PACKAGES MPI MPI::MPI_CXX)
boxstream_adapter(tbb FOLDER tbb ABOUT "boxstream on the threads of oneTBB"
  NEEDS "oneTBB and its CMake package TBB (Debian: libtbb-dev)" PACKAGES TBB TBB::tbb REQUIRES tbb)

include(${CMAKE_CURRENT_LIST_DIR}/find_bullet.cmake)

# boxstream_find_adapter(<reason> <component>): finds what the component needs, or gives the reason why it cannot. A
# macro, because imported targets must end up in the caller's directory. Configs rather than modules: CGAL brings a module
# for Eigen that makes no target. MPI has only CMake's module, which would find that of the host when cross-compiling.
macro(boxstream_find_adapter reason component)
  set(${reason} "")
  set(boxstream_packages ${boxstream_${component}_PACKAGES})
  if(boxstream_${component}_FOLDER STREQUAL "bullet")
    boxstream_find_bullet(${reason} ${component})
  endif()
  if(${component} STREQUAL "coal" AND NOT TARGET coal::coal)
    find_package(coal CONFIG QUIET)
    if(NOT TARGET coal::coal)
      find_package(hpp-fcl 2.4 CONFIG QUIET)
      if(TARGET hpp-fcl::hpp-fcl)
        add_library(coal::coal INTERFACE IMPORTED)
        set_property(TARGET coal::coal PROPERTY INTERFACE_LINK_LIBRARIES hpp-fcl::hpp-fcl)
        set(boxstream_coal_REQUIRES hpp-fcl)
      endif()
    endif()
  endif()
  while(boxstream_packages)
    list(POP_FRONT boxstream_packages boxstream_package boxstream_target)
    if(NOT TARGET ${boxstream_target} AND NOT boxstream_package STREQUAL "MPI")
      find_package(${boxstream_package} CONFIG QUIET)
    elseif(NOT TARGET ${boxstream_target} AND NOT CMAKE_CROSSCOMPILING)
      find_package(MPI QUIET COMPONENTS CXX)
    endif()
    if(NOT TARGET ${boxstream_target})
      set(${reason} "component ${component} needs ${boxstream_${component}_NEEDS}")
      set(boxstream_packages "")
    endif()
  endwhile()
endmacro()

# boxstream_shorter(<result> <word>): the word, and what is left of it without one of its letters.
function(boxstream_shorter result word)
  set(all ${word})
  string(LENGTH ${word} length)
  math(EXPR last "${length} - 1")
  foreach(i RANGE ${last})
    string(SUBSTRING ${word} 0 ${i} before)
    math(EXPR next "${i} + 1")
    string(SUBSTRING ${word} ${next} -1 after)
    list(APPEND all "${before}${after}")
  endforeach()
  set(${result} "${all}" PARENT_SCOPE)
endfunction()

# boxstream_guess(<result> <component> <known>...): " (did you mean ...?)" for one whose name is the beginning of that of a
# known one, or a letter apart, whatever is in capitals; else nothing. Words are a letter apart if they become the same
# without one letter each; not those of two letters.
function(boxstream_guess result component)
  set(${result} "" PARENT_SCOPE)
  string(TOLOWER "${component}" given)
  string(REGEX REPLACE "[^a-z0-9]" "_" given "${given}")
  boxstream_shorter(given_shorter "${given}")
  foreach(known IN LISTS ARGN)
    string(FIND "${known}" "${given}" place)
    set(is_near FALSE)
    if(place EQUAL 0)
      set(is_near TRUE)
    elseif(given MATCHES "..." AND known MATCHES "...")
      boxstream_shorter(known_shorter ${known})
      foreach(word IN LISTS given_shorter)
        if(word IN_LIST known_shorter)
          set(is_near TRUE)
        endif()
      endforeach()
    endif()
    if(is_near)
      set(${result} " (did you mean ${known}?)" PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()
