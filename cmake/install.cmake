# SPDX-License-Identifier: MIT
# One export set and one .pc file for each component, because each has dependencies that the others can do without.
# `cmake --install BUILD --component` knows others, those of an installation: library (what runs), development (what is
# compiled with), tools, scenes and licences.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(boxstream_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/boxstream)
set(boxstream_pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
# Paths in .pc files start from where the file itself is, so that the installed tree can be moved.
file(RELATIVE_PATH boxstream_pc_to_prefix /${boxstream_pc_dir} /)

# boxstream_install_component(<component> <targets> <folder of the headers>)
function(boxstream_install_component component targets folder)
  install(TARGETS ${targets} EXPORT boxstream-${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT library
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT boxstream-${component} NAMESPACE boxstream:: DESTINATION ${boxstream_cmake_dir}
    FILE boxstream-${component}-targets.cmake COMPONENT development)
  install(DIRECTORY ${folder}/include/boxstream DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
    FILES_MATCHING PATTERN *.hpp PATTERN *.h)
endfunction()

# boxstream_install_pc(<template> <name>)
function(boxstream_install_pc template name)
  configure_file(cmake/${template} ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/${name}.pc DESTINATION ${boxstream_pc_dir} COMPONENT development)
endfunction()

# boxstream_adapter_pc(<component>)
function(boxstream_adapter_pc component)
  string(REPLACE "_" "-" name boxstream-${component})
  set(about "${boxstream_${component}_ABOUT}")
  if(component STREQUAL "c")  # a shared library: its users need nothing else
    boxstream_install_pc(boxstream-c.pc.in ${name})
    return()
  endif()
  set(requires "${boxstream_${component}_REQUIRES}")
  set(libs "")
  set(cflags "-I\${includedir}")
  get_target_property(type boxstream_${component} TYPE)
  if(NOT type STREQUAL "INTERFACE_LIBRARY")
    set(libs "-L\${libdir} -lboxstream_${component}")
  endif()
  get_target_property(definitions boxstream_${component} INTERFACE_COMPILE_DEFINITIONS)
  foreach(definition IN LISTS definitions)
    if(definition)
      string(APPEND cflags " -D${definition}")
    endif()
  endforeach()
  # A .pc file can ask for Bullet only where that came from pkg-config.
  if(boxstream_${component}_FOLDER STREQUAL "bullet")
    set(requires "${boxstream_${component}_module}")
  # FCL's own fcl.pc sets -std=c++11, after whatever standard its user sets: this one has what else is in it. Without
  # fcl.pc, whatever the user's has.
  elseif(component STREQUAL "fcl")
    find_package(PkgConfig QUIET)
    if(PkgConfig_FOUND)
      pkg_check_modules(fcl_pc QUIET fcl)
    endif()
    if(fcl_pc_FOUND)
      execute_process(COMMAND ${PKG_CONFIG_EXECUTABLE} --print-requires fcl
        OUTPUT_VARIABLE requires OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
      string(REPLACE "\n" ", " requires "${requires}")
      set(libs "-L${fcl_pc_LIBDIR} -lfcl")
      string(APPEND cflags " -I${fcl_pc_INCLUDEDIR}")
    endif()
  endif()
  if(requires)
    boxstream_install_pc(boxstream-adapter.pc.in ${name})
  endif()
endfunction()

# Programs that link the static library link Highway too, with or without --static.
set(requires "libhwy >= 1.0")
if(BUILD_SHARED_LIBS)
  set(requires "")
endif()
boxstream_install_component(core boxstream .)
boxstream_install_pc(boxstream.pc.in boxstream)
foreach(component IN LISTS boxstream_built_adapters)
  set(targets boxstream_${component})
  if(TARGET boxstream_${component}_compiled)
    list(APPEND targets boxstream_${component}_compiled)
  endif()
  boxstream_install_component(${component} "${targets}" adapters/${boxstream_${component}_FOLDER})
  boxstream_adapter_pc(${component})
endforeach()

configure_package_config_file(cmake/boxstream-config.cmake.in ${PROJECT_BINARY_DIR}/boxstream-config.cmake
  INSTALL_DESTINATION ${boxstream_cmake_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before version 1.0 every minor version may break the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/boxstream-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/boxstream-config.cmake ${PROJECT_BINARY_DIR}/boxstream-config-version.cmake
  cmake/adapters.cmake cmake/find_bullet.cmake
  DESTINATION ${boxstream_cmake_dir} COMPONENT development)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT licences)

# `cpack` in the build tree: all of this as an archive. Archives of the sources are made by ./dev dist.
if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR TGZ)
  set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
  include(CPack)
endif()
