# SPDX-License-Identifier: MIT
# Where Bullet comes from, and mixtures that are refused.
if(NOT TARGET boxstream::bullet OR NOT TARGET boxstream::bullet_float64)
  return()
endif()
set(vendored ${CMAKE_CURRENT_SOURCE_DIR}/vendored)
set(sources -DBOXSTREAM_SOURCE=${PROJECT_SOURCE_DIR} -DCMAKE_BUILD_TYPE=Debug -DBOXSTREAM_FCL=OFF
  -DBOXSTREAM_SANITIZE=${BOXSTREAM_SANITIZE})

# The project's own Bullet is what boxstream::bullet is compiled for and links, in the precision that it has.
foreach(component IN ITEMS bullet bullet_float64)
  boxstream_project_test(vendored_${component} ${vendored} ${CMAKE_CTEST_COMMAND} -DCOMPONENT=${component} ${sources})
endforeach()
boxstream_project_test(vendored_named ${vendored} ${CMAKE_CTEST_COMMAND} -DCOMPONENT=bullet
  -DCMAKE_PREFIX_PATH=${prefix} "-DBOXSTREAM_BULLET_TARGET=BulletDynamics$<SEMICOLON>BulletCollision$<SEMICOLON>LinearMath")
boxstream_refusal_test(vendored_late "boxstream came first: add Bullet before boxstream" PROJECT ${vendored}
  -DCOMPONENT=bullet -DLATE=ON ${sources})
boxstream_refusal_test(vendored_late_installed "boxstream came first: add Bullet before boxstream" PROJECT ${vendored}
  -DCOMPONENT=bullet -DLATE=ON)
boxstream_refusal_test(vendored_beside_installed "this project builds Bullet itself" PROJECT ${vendored}
  -DCOMPONENT=bullet)
boxstream_refusal_test(vendored_wrong_name "names Bulet, and there is no such target" PROJECT ${vendored}
  -DCOMPONENT=bullet -DBOXSTREAM_BULLET_TARGET=Bulet ${sources})

# Bullet's CMake package, which names neither targets nor absolute folders.
boxstream_project_test(bullet_by_package ${consumer} ${CMAKE_CTEST_COMMAND} -DCMAKE_PREFIX_PATH=${prefix}
  -DCOMPONENTS=bullet,bullet_float64)
set_property(TEST package.bullet_by_package APPEND PROPERTY ENVIRONMENT PKG_CONFIG_LIBDIR=/nonexistent)

# An upstream build in double precision calls its module bullet as well.
set(upstream ${CMAKE_CURRENT_BINARY_DIR}/upstream)
file(WRITE ${upstream}/bullet.pc "Name: bullet
Description: Bullet in double precision
Version: 3.24
Libs: -lBulletSoftBody-float64 -lBulletDynamics-float64 -lBulletCollision-float64 -lLinearMath-float64
Cflags: -DBT_USE_DOUBLE_PRECISION -I/usr/include/bullet
")
boxstream_project_test(upstream_double ${consumer} ${CMAKE_CTEST_COMMAND} -DCMAKE_PREFIX_PATH=${prefix}
  -DCOMPONENTS=bullet_float64 -DCMAKE_DISABLE_FIND_PACKAGE_Bullet=ON)
boxstream_refusal_test(upstream_double_is_not_single "component bullet needs Bullet," -DCOMPONENTS=bullet
  -DCMAKE_DISABLE_FIND_PACKAGE_Bullet=ON)
set_property(TEST package.upstream_double package.upstream_double_is_not_single APPEND PROPERTY
  ENVIRONMENT PKG_CONFIG_LIBDIR=${upstream})

boxstream_refusal_test(double_everywhere "this project defines BT_USE_DOUBLE_PRECISION for all" -DCOMPONENTS=bullet
  -DDOUBLE_EVERYWHERE=ON)
boxstream_project_test(wrong_precision ${consumer} ${CMAKE_CTEST_COMMAND} -DCMAKE_PREFIX_PATH=${prefix}
  -DCOMPONENTS=bullet -DWRONG_PRECISION=ON)
set_tests_properties(package.wrong_precision PROPERTIES PASS_REGULAR_EXPRESSION
  "#error .boxstream::bullet is for Bullet in single precision, and BT_USE_DOUBLE_PRECISION is defined")
