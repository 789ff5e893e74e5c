# SPDX-License-Identifier: MIT
# Worlds of Bullet in double precision. Both precisions of Bullet have the same names, so that they cannot be in one
# program: rooms that see numbers of Bullet are compiled a second time, for the program that `boxstream simulate` runs in
# its place (boxstream/in_double).
find_library(BULLET_WORLD_IMPORTER_LIBRARY BulletWorldImporter)
find_library(BULLET_WORLD_IMPORTER_FLOAT64_LIBRARY BulletWorldImporter-float64)
find_library(BULLET_FILE_LOADER_FLOAT64_LIBRARY BulletFileLoader-float64)
mark_as_advanced(BULLET_WORLD_IMPORTER_FLOAT64_LIBRARY BULLET_FILE_LOADER_FLOAT64_LIBRARY)
set(boxstream_with_doubles TRUE)
if(NOT TARGET boxstream::bullet OR NOT TARGET boxstream::bullet_float64)
  set(boxstream_with_doubles FALSE)
elseif("boxstream/in_double" IN_LIST BOXSTREAM_DEMOS_WITHOUT)
  set(boxstream_with_doubles FALSE)
elseif(BULLET_WORLD_IMPORTER_LIBRARY AND NOT (BULLET_WORLD_IMPORTER_FLOAT64_LIBRARY AND BULLET_FILE_LOADER_FLOAT64_LIBRARY))
  # Files that one of the programs reads, the other does.
  set(boxstream_with_doubles FALSE)
endif()

# boxstream_to_link_in_double(RESULT LIBRARY...): what stands for these.
function(boxstream_to_link_in_double result)
  set(linked "")
  foreach(library IN LISTS ARGN)
    if(library MATCHES "^boxstream(_dependency)?::bullet$")
      set(library ${library}_float64)
    elseif(library STREQUAL "${BULLET_WORLD_IMPORTER_LIBRARY}")
      set(library ${BULLET_WORLD_IMPORTER_FLOAT64_LIBRARY})
    elseif(library STREQUAL "${BULLET_FILE_LOADER_LIBRARY}")
      set(library ${BULLET_FILE_LOADER_FLOAT64_LIBRARY})
    elseif(TARGET ${library}_double)
      set(library ${library}_double)
    endif()
    list(APPEND linked ${library})
  endforeach()
  set(${result} ${linked} PARENT_SCOPE)
endfunction()

# boxstream_compile_in_double(TARGET): TARGET_double, of the same sources and with the same options. To be called where
# TARGET is made, when all of it is known.
function(boxstream_compile_in_double target)
  if(NOT boxstream_with_doubles)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  add_library(${target}_double STATIC ${sources})
  foreach(property IN ITEMS COMPILE_OPTIONS COMPILE_DEFINITIONS INCLUDE_DIRECTORIES INTERFACE_COMPILE_DEFINITIONS
      INTERFACE_INCLUDE_DIRECTORIES)
    get_target_property(value ${target} ${property})
    if(value)
      set_target_properties(${target}_double PROPERTIES ${property} "${value}")
    endif()
  endforeach()
  get_target_property(libraries ${target} LINK_LIBRARIES)
  boxstream_to_link_in_double(libraries ${libraries})
  target_link_libraries(${target}_double PUBLIC ${libraries})
endfunction()
