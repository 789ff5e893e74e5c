# SPDX-License-Identifier: MIT
# One export set and one .pc file for each component, because each has dependencies that the others can do without.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(boxstream_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/boxstream)
set(boxstream_pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
# Paths in .pc files start from where the file itself is, so that the installed tree can be moved.
file(RELATIVE_PATH boxstream_pc_to_prefix /${boxstream_pc_dir} /)

# boxstream_install_component(<component> <target> <name of the .pc file> <include directory>)
function(boxstream_install_component component target pc_name include_dir)
  install(TARGETS ${target} EXPORT boxstream-${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
    INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(EXPORT boxstream-${component} NAMESPACE boxstream:: DESTINATION ${boxstream_cmake_dir}
    FILE boxstream-${component}-targets.cmake)
  install(DIRECTORY ${include_dir}/boxstream DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN *.hpp)
  # A .pc file can ask for Bullet only where that came from pkg-config.
  if(NOT component MATCHES "^bullet" OR boxstream_${component}_module)
    configure_file(cmake/${pc_name}.pc.in ${PROJECT_BINARY_DIR}/pkgconfig/${pc_name}.pc @ONLY)
    install(FILES ${PROJECT_BINARY_DIR}/pkgconfig/${pc_name}.pc DESTINATION ${boxstream_pc_dir})
  endif()
endfunction()

boxstream_install_component(core boxstream boxstream include)
if(TARGET boxstream_bullet)
  boxstream_install_component(bullet boxstream_bullet boxstream-bullet adapters/bullet/include)
endif()
if(TARGET boxstream_bullet_float64)
  boxstream_install_component(bullet_float64 boxstream_bullet_float64 boxstream-bullet-float64 adapters/bullet/include)
endif()
if(TARGET boxstream_ccd)
  boxstream_install_component(ccd boxstream_ccd boxstream-ccd adapters/ccd/include)
endif()
if(TARGET boxstream_tbb)
  boxstream_install_component(tbb boxstream_tbb boxstream-tbb adapters/tbb/include)
endif()
if(TARGET boxstream_fcl)
  # As fcl.pc has it, but for its -std=c++11. Without fcl.pc, whatever the user's has.
  set(boxstream_fcl_requires fcl)
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(fcl_pc QUIET fcl)
  endif()
  if(fcl_pc_FOUND)
    execute_process(COMMAND ${PKG_CONFIG_EXECUTABLE} --print-requires fcl
      OUTPUT_VARIABLE boxstream_fcl_requires OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    string(REPLACE "\n" ", " boxstream_fcl_requires "${boxstream_fcl_requires}")
    set(boxstream_fcl_libs "-L${fcl_pc_LIBDIR} -lfcl")
    set(boxstream_fcl_cflags "-I${fcl_pc_INCLUDEDIR}")
  endif()
  boxstream_install_component(fcl boxstream_fcl boxstream-fcl adapters/fcl/include)
endif()

configure_package_config_file(cmake/boxstream-config.cmake.in ${PROJECT_BINARY_DIR}/boxstream-config.cmake
  INSTALL_DESTINATION ${boxstream_cmake_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before version 1.0 every minor version may break the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/boxstream-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/boxstream-config.cmake ${PROJECT_BINARY_DIR}/boxstream-config-version.cmake
  cmake/find_bullet.cmake
  DESTINATION ${boxstream_cmake_dir})
