# SPDX-License-Identifier: MIT
# The same package with shared libraries (BUILD_SHARED_LIBS): users' projects link them and find them without more.
if(WIN32 OR APPLE)
  return()
endif()
set(shared_prefix ${CMAKE_CURRENT_BINARY_DIR}/shared_prefix)
boxstream_project_test(shared_install ${PROJECT_SOURCE_DIR}
  "${CMAKE_COMMAND};-DBUILD=.;-DPREFIX=${shared_prefix};-DCONFIG=$<CONFIG>;-P;${CMAKE_CURRENT_SOURCE_DIR}/install.cmake"
  -DBUILD_SHARED_LIBS=ON -DCMAKE_UNITY_BUILD=ON -DBOXSTREAM_DEMOS=OFF -DBOXSTREAM_PYTHON_PACKAGE=OFF
  -DBOXSTREAM_SANITIZE=${BOXSTREAM_SANITIZE})
set_tests_properties(package.shared_install PROPERTIES FIXTURES_SETUP shared_installed FIXTURES_REQUIRED "" TIMEOUT 1500)

boxstream_project_test(shared_find_package ${consumer} ${CMAKE_CTEST_COMMAND}
  -DCMAKE_PREFIX_PATH=${shared_prefix} -DCOMPONENTS=${components_text} -DSHARED=ON)
# Whoever links the shared library needs no Highway.
boxstream_project_test(shared_without_highway ${consumer} ${CMAKE_CTEST_COMMAND} -DCMAKE_PREFIX_PATH=${shared_prefix}
  -DCOMPONENTS=core -DCMAKE_DISABLE_FIND_PACKAGE_hwy=ON)
boxstream_pkg_config_test(shared_pkg_config ${shared_prefix})
boxstream_components_test(shared_components ${CMAKE_CURRENT_BINARY_DIR}/shared_install ${shared_prefix})
set_tests_properties(package.shared_find_package package.shared_without_highway package.shared_pkg_config
  package.shared_components PROPERTIES FIXTURES_REQUIRED shared_installed)

find_program(DOXYGEN_PROGRAM doxygen)
find_program(BOXSTREAM_PYTHON python3)
if(DOXYGEN_PROGRAM AND BOXSTREAM_PYTHON AND "ccd" IN_LIST boxstream_built_adapters AND NOT BOXSTREAM_SANITIZE)
  set(libraries boxstream boxstream_bullet boxstream_bullet_float64 boxstream_ccd)
  list(TRANSFORM libraries REPLACE "(.+)" "${shared_prefix}/${CMAKE_INSTALL_LIBDIR}/lib\\1.so")
  add_test(NAME package.shared_exports COMMAND ${BOXSTREAM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/exports_test.py
    ${CMAKE_NM} ${DOXYGEN_PROGRAM} docs/Doxyfile ${CMAKE_CURRENT_BINARY_DIR}/exports ${libraries}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(package.shared_exports PROPERTIES LABELS package FIXTURES_REQUIRED shared_installed)
endif()

# The list of symbols that Debian's packages come with is complete and right.
find_program(GENSYMBOLS_PROGRAM dpkg-gensymbols)
mark_as_advanced(GENSYMBOLS_PROGRAM)
if(GENSYMBOLS_PROGRAM AND "ccd" IN_LIST boxstream_built_adapters AND "bullet_float64" IN_LIST boxstream_built_adapters
    AND NOT BOXSTREAM_SANITIZE)
  set(libraries boxstream boxstream_bullet boxstream_bullet_float64 boxstream_c boxstream_ccd)
  list(TRANSFORM libraries REPLACE "(.+)" "-e${shared_prefix}/${CMAKE_INSTALL_LIBDIR}/lib\\1.so")
  add_test(NAME package.shared_symbols COMMAND ${GENSYMBOLS_PROGRAM} -plibboxstream0 -v${PROJECT_VERSION} -c4
    -Idebian/libboxstream0.symbols -O${CMAKE_CURRENT_BINARY_DIR}/libboxstream0.symbols ${libraries}
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR})
  set_tests_properties(package.shared_symbols PROPERTIES LABELS package FIXTURES_REQUIRED shared_installed)
endif()
