# SPDX-License-Identifier: MIT
# Static and shared libraries are made of the same objects, which hide what BOXSTREAM_API does not mark: docs/abi.md.

# The number in the names of shared libraries: one more with each release that takes a symbol away or changes one.
set(boxstream_abi 0)

# On Windows the libraries for C++ are always static: nothing marks what a DLL would export.
if(WIN32)
  set(BUILD_SHARED_LIBS OFF)
endif()
if(BUILD_SHARED_LIBS)
  foreach(part IN ITEMS TESTS BENCH)
    if(BOXSTREAM_${part} STREQUAL "AUTO")
      set(BOXSTREAM_${part} OFF)
    elseif(BOXSTREAM_${part})
      message(FATAL_ERROR "BOXSTREAM_${part} is ON, and takes static libraries: it reaches what shared ones hide")
    endif()
  endforeach()
endif()

# boxstream_can_be_shared(<target>): what one finds of the others lies beside it.
function(boxstream_can_be_shared target)
  set_target_properties(${target} PROPERTIES
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON DEFINE_SYMBOL ""
    VERSION ${boxstream_abi}.${PROJECT_VERSION_MINOR}.${PROJECT_VERSION_PATCH} SOVERSION ${boxstream_abi})
  if(NOT APPLE)
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "\$ORIGIN")
  endif()
endfunction()
