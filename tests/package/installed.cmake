# SPDX-License-Identifier: MIT
# Projects outside this one, built against the installed package, as users do it.
include(GNUInstallDirs)
set(prefix ${CMAKE_CURRENT_BINARY_DIR}/prefix)
set(components core ${boxstream_built_adapters})
string(REPLACE ";" "," components_text "${components}")
# A sanitized library needs a sanitized program.
string(REPLACE ";" " " user_flags "${boxstream_sanitize_flags}")

# Installed anew for each run, so that no file of an earlier version hides a missing one.
add_test(NAME package.install COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -DPREFIX=${prefix}
  -DCONFIG=$<CONFIG> -P ${CMAKE_CURRENT_SOURCE_DIR}/install.cmake)
set_tests_properties(package.install PROPERTIES LABELS package FIXTURES_SETUP installed)

find_program(READELF_PROGRAM readelf)
mark_as_advanced(READELF_PROGRAM)
if(TARGET boxstream_tool AND BOXSTREAM_HARDENED AND NOT BOXSTREAM_SANITIZE AND READELF_PROGRAM)
  add_test(NAME package.hardened COMMAND ${CMAKE_COMMAND} -DPREFIX=${prefix} -DBINDIR=${CMAKE_INSTALL_BINDIR}
    -DLIBDIR=${CMAKE_INSTALL_LIBDIR} -DREADELF=${READELF_PROGRAM} -DDOUBLE=$<TARGET_EXISTS:boxstream_tool_double> -DCHECKED=$<NOT:$<CONFIG:Debug>>
    -P ${CMAKE_CURRENT_SOURCE_DIR}/hardened.cmake)
  set_tests_properties(package.hardened PROPERTIES LABELS package FIXTURES_REQUIRED installed)
endif()

# boxstream_project_test(<name> <source directory> <test command> <options>...)
function(boxstream_project_test name source command)
  set(build ${CMAKE_CURRENT_BINARY_DIR}/${name})
  add_test(NAME package.${name} COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${source} ${build}
    --build-generator ${CMAKE_GENERATOR} --build-noclean --build-options
    -DCMAKE_BUILD_TYPE=$<CONFIG> -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_CXX_FLAGS=${user_flags}
    -DCMAKE_CXX_COMPILER_LAUNCHER=${CCACHE_PROGRAM} ${ARGN}
    --test-command ${command})
  set_tests_properties(package.${name} PROPERTIES LABELS package FIXTURES_REQUIRED installed
    ENVIRONMENT "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR};CCACHE_NOHASHDIR=1")
endfunction()

# boxstream_refusal_test(<name> <what CMake must say> <options>...): configuring the consumer, or what PROJECT names,
# fails.
function(boxstream_refusal_test name message)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "PROJECT" "")
  if(NOT arg_PROJECT)
    set(arg_PROJECT ${consumer})
  endif()
  add_test(NAME package.${name} COMMAND ${CMAKE_COMMAND} -S ${arg_PROJECT} -B ${CMAKE_CURRENT_BINARY_DIR}/${name}
    -G ${CMAKE_GENERATOR} -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} ${arg_UNPARSED_ARGUMENTS})
  # CMake breaks its messages into lines.
  string(REPLACE " " "[ \n]+" pattern "${message}")
  set_tests_properties(package.${name} PROPERTIES LABELS package FIXTURES_REQUIRED installed
    PASS_REGULAR_EXPRESSION "${pattern}" FAIL_REGULAR_EXPRESSION "Build files have been written")
endfunction()

set(consumer ${CMAKE_CURRENT_SOURCE_DIR}/consumer)
boxstream_project_test(find_package ${consumer} ${CMAKE_CTEST_COMMAND}
  -DCMAKE_PREFIX_PATH=${prefix} -DCOMPONENTS=${components_text})
# Not optimised, as that takes most of the time.
boxstream_project_test(add_subdirectory ${consumer} ${CMAKE_CTEST_COMMAND} -DCMAKE_BUILD_TYPE=Debug
  -DBOXSTREAM_SOURCE=${PROJECT_SOURCE_DIR} -DCOMPONENTS=${components_text} -DBOXSTREAM_SANITIZE=${BOXSTREAM_SANITIZE})

# boxstream_pkg_config_test(<name> <prefix>)
function(boxstream_pkg_config_test name prefix)
  add_test(NAME package.${name} COMMAND ${CMAKE_COMMAND} -DCOMPONENTS=${components_text}
    -DPREFIX=${prefix} -DLIBDIR=${CMAKE_INSTALL_LIBDIR} -DCXX=${CMAKE_CXX_COMPILER} -DFLAGS=${user_flags}
    -DSOURCE=${consumer} -DBUILD=${CMAKE_CURRENT_BINARY_DIR}/${name} -DPAGE=${PROJECT_SOURCE_DIR}/docs/build.md
    -P ${CMAKE_CURRENT_SOURCE_DIR}/pkg_config.cmake)
  set_tests_properties(package.${name} PROPERTIES LABELS package FIXTURES_REQUIRED installed)
endfunction()
boxstream_pkg_config_test(pkg_config ${prefix})

# boxstream_components_test(<name> <build tree> <what is installed of it>)
function(boxstream_components_test name build prefix)
  add_test(NAME package.${name} COMMAND ${CMAKE_COMMAND} -DBUILD=${build} -DPREFIX=${prefix} -DCONFIG=$<CONFIG>
    -DFOLDER=${CMAKE_CURRENT_BINARY_DIR}/${name} -P ${CMAKE_CURRENT_SOURCE_DIR}/components.cmake)
  set_tests_properties(package.${name} PROPERTIES LABELS package FIXTURES_REQUIRED installed)
endfunction()
boxstream_components_test(components ${PROJECT_BINARY_DIR} ${prefix})

# boxstream_swap_test(<program>): what it prints is the same before and after the swap.
function(boxstream_swap_test program)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${program}.txt)
  set(same_output -P ${CMAKE_CURRENT_SOURCE_DIR}/same_output.cmake)
  boxstream_project_test(${program}_before ${readme_dir}/${program}/before
    "${CMAKE_COMMAND};-DPROGRAM=./hello;-DEXPECTED=${output};-DRECORD=ON;${same_output}")
  boxstream_project_test(${program}_after ${readme_dir}/${program}/after
    "${CMAKE_COMMAND};-DPROGRAM=./hello;-DEXPECTED=${output};${same_output}" -DCMAKE_PREFIX_PATH=${prefix})
  set_tests_properties(package.${program}_before PROPERTIES FIXTURES_SETUP ${program}_output)
  set_tests_properties(package.${program}_after PROPERTIES FIXTURES_REQUIRED "installed;${program}_output")
endfunction()

if(TARGET boxstream::bullet)
  boxstream_swap_test(hello_bullet)
  boxstream_refusal_test(without_bullet "component bullet needs Bullet," -DCOMPONENTS=core,bullet
    -DCMAKE_DISABLE_FIND_PACKAGE_Bullet=ON)
  set_tests_properties(package.without_bullet PROPERTIES ENVIRONMENT PKG_CONFIG_LIBDIR=/nonexistent)
endif()
if(TARGET boxstream::fcl)
  boxstream_swap_test(hello_fcl)
  boxstream_project_test(own_fcl ${CMAKE_CURRENT_SOURCE_DIR}/own_fcl ${CMAKE_CTEST_COMMAND} -DCMAKE_PREFIX_PATH=${prefix})
  boxstream_refusal_test(without_fcl "component fcl needs FCL and" -DCOMPONENTS=core,fcl
    -DCMAKE_DISABLE_FIND_PACKAGE_fcl=ON)
endif()
if(TARGET boxstream::bullet AND TARGET boxstream::bullet_float64)
  boxstream_refusal_test(both_precisions "INTERFACE_BOXSTREAM_BULLET_PRECISION property of"
    -DCOMPONENTS=bullet,bullet_float64 -DBOTH_PRECISIONS=ON)
endif()
include(bullets.cmake)
if(TARGET boxstream::ccd)
  boxstream_refusal_test(without_ccd "component ccd needs libccd" -DCOMPONENTS=core,ccd
    -DCMAKE_DISABLE_FIND_PACKAGE_ccd=ON)
endif()
if(TARGET boxstream::mpi)
  boxstream_refusal_test(without_mpi "component mpi needs MPI for" -DCOMPONENTS=core,mpi
    -DCMAKE_DISABLE_FIND_PACKAGE_MPI=ON)
endif()
boxstream_refusal_test(unknown_component "no component havok; known: core bullet" -DCOMPONENTS=havok)
boxstream_refusal_test(mistyped_component "no component bulet [(]did you mean bullet[?][)]; known" -DCOMPONENTS=bulet)
add_test(NAME package.guesses COMMAND ${CMAKE_COMMAND} -DCMAKE_DIR=${PROJECT_SOURCE_DIR}/cmake
  -P ${CMAKE_CURRENT_SOURCE_DIR}/guesses.cmake)
set_tests_properties(package.guesses PROPERTIES LABELS package)
