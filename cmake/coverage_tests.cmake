# SPDX-License-Identifier: MIT
# Target boxstream_coverage_tests builds the tests of what ./dev coverage looks at: core and adapters.
if(BOXSTREAM_TESTS_OF)
  return()
endif()
add_custom_target(boxstream_coverage_tests)
foreach(directory IN ITEMS core objects box_index out_of_core world bullet ccd fcl)
  get_property(targets DIRECTORY ${PROJECT_SOURCE_DIR}/tests/library/${directory} PROPERTY BUILDSYSTEM_TARGETS)
  if(targets)
    add_dependencies(boxstream_coverage_tests ${targets})
  endif()
endforeach()
