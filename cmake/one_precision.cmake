# SPDX-License-Identifier: MIT
# Linking both precisions of Bullet into one program succeeds and then corrupts data, so CMake refuses it: the property
# must have the same value in everything that a target links. It is exported with the installed targets.
foreach(module IN ITEMS bullet bullet_float64)
  if(TARGET boxstream_${module})
    set_property(TARGET boxstream_${module} PROPERTY INTERFACE_BOXSTREAM_BULLET_PRECISION ${module})
    set_property(TARGET boxstream_${module} APPEND PROPERTY COMPATIBLE_INTERFACE_STRING BOXSTREAM_BULLET_PRECISION)
  endif()
endforeach()
