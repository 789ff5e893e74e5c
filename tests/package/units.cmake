# SPDX-License-Identifier: MIT
# The presets behind ./dev install and ./dev demo compile: they put many sources into one unit, where names of two can clash.
# Not optimised, as that takes most of the time.
if(CMAKE_BUILD_TYPE STREQUAL Release AND CMAKE_GENERATOR STREQUAL Ninja AND NOT BOXSTREAM_SANITIZE)
  foreach(preset_target IN ITEMS "library;all" "demo;boxstream_tool")
    list(GET preset_target 0 preset)
    list(GET preset_target 1 target)
    set(build ${CMAKE_CURRENT_BINARY_DIR}/units_${preset})
    add_test(NAME package.units_${preset}_configure WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
      COMMAND ${CMAKE_COMMAND} --preset ${preset} -B ${build} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}
        -DCMAKE_CXX_FLAGS_RELEASE=-DNDEBUG -DBOXSTREAM_WERROR=${BOXSTREAM_WERROR})
    add_test(NAME package.units_${preset} COMMAND ${CMAKE_COMMAND} --build ${build} --target ${target} --parallel 2)
    set_tests_properties(package.units_${preset}_configure PROPERTIES LABELS package FIXTURES_SETUP units_${preset})
    set_tests_properties(package.units_${preset} PROPERTIES
      LABELS package FIXTURES_REQUIRED units_${preset} PROCESSORS 2 TIMEOUT 900)
  endforeach()
endif()
