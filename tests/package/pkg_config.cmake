# SPDX-License-Identifier: MIT
# Builds the consumer's programs with nothing but the compiler and pkg-config, and runs them.
string(REPLACE "," ";" components "${COMPONENTS}")
set(ENV{PKG_CONFIG_PATH} ${PREFIX}/${LIBDIR}/pkgconfig)
separate_arguments(flags UNIX_COMMAND "${FLAGS}")
file(MAKE_DIRECTORY ${BUILD})

foreach(component IN LISTS components)
  if(component STREQUAL "core")
    set(module boxstream)
    set(source core.cpp)
  else()
    string(REPLACE "_" "-" module boxstream-${component})
    set(source bullet.cpp)
  endif()
  execute_process(COMMAND pkg-config --cflags --libs ${module}
    OUTPUT_VARIABLE module_flags OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  message("${module}: ${module_flags}")
  separate_arguments(module_flags UNIX_COMMAND "${module_flags}")
  execute_process(COMMAND ${CXX} -std=c++17 ${flags} ${SOURCE}/${source} -o ${BUILD}/${component} ${module_flags}
    COMMAND_ERROR_IS_FATAL ANY)
  if(component STREQUAL "bullet_float64")
    set(precision double)
  else()
    set(precision float)
  endif()
  execute_process(COMMAND ${BUILD}/${component} ${precision} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
