# SPDX-License-Identifier: MIT
# Shared libraries hide what BOXSTREAM_API does not mark: docs/abi.md.

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

# boxstream_can_be_shared(<target> <map of exports>): what one finds of the others lies beside it. Static libraries are
# compiled as if there were no shared ones.
function(boxstream_can_be_shared target exports)
  get_target_property(type ${target} TYPE)
  if(NOT type STREQUAL "SHARED_LIBRARY")
    return()
  endif()
  target_compile_definitions(${target} PRIVATE BOXSTREAM_SHARED)
  set_target_properties(${target} PROPERTIES
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON DEFINE_SYMBOL ""
    VERSION ${boxstream_abi}.${PROJECT_VERSION_MINOR}.${PROJECT_VERSION_PATCH} SOVERSION ${boxstream_abi})
  if(NOT APPLE AND NOT WIN32)
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "\$ORIGIN" LINK_DEPENDS ${exports})
    target_link_options(${target} PRIVATE LINKER:--version-script=${exports})
  endif()
endfunction()
