# SPDX-License-Identifier: MIT
# Programs named *_threads_test or *_threads_tests hold the tests that are worth running under ThreadSanitizer: their
# tests are labelled "threads" beside the name of their directory, and target boxstream_threads_tests builds them.
add_custom_target(boxstream_threads_tests)

function(boxstream_collect_threads_tests directory)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  list(FILTER targets INCLUDE REGEX "_threads_tests?$")
  get_filename_component(name ${directory} NAME)
  foreach(target IN LISTS targets)
    add_dependencies(boxstream_threads_tests ${target})
    # gtest_discover_tests cannot pass two labels, so a script gives them when ctest starts, to the tests that it found.
    set(script ${PROJECT_BINARY_DIR}/labels/${target}.cmake)
    file(CONFIGURE OUTPUT ${script} @ONLY CONTENT [[
if(@target@_TESTS)
  set_tests_properties(${@target@_TESTS} PROPERTIES LABELS "@name@;threads")
endif()
]])
    set_property(DIRECTORY ${directory} APPEND PROPERTY TEST_INCLUDE_FILES ${script})
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory IN LISTS subdirectories)
    boxstream_collect_threads_tests(${subdirectory})
  endforeach()
endfunction()

boxstream_collect_threads_tests(${PROJECT_SOURCE_DIR}/tests)
