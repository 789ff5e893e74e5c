# SPDX-License-Identifier: MIT
# Target boxstream_threads_tests: the test programs named *_threads_test or *_threads_tests, which hold the tests that
# are labelled "threads". They are all that is worth building for ThreadSanitizer.
add_custom_target(boxstream_threads_tests)

function(boxstream_collect_threads_tests directory)
  get_property(targets DIRECTORY ${directory} PROPERTY BUILDSYSTEM_TARGETS)
  list(FILTER targets INCLUDE REGEX "_threads_tests?$")
  foreach(target IN LISTS targets)
    add_dependencies(boxstream_threads_tests ${target})
  endforeach()
  get_property(subdirectories DIRECTORY ${directory} PROPERTY SUBDIRECTORIES)
  foreach(subdirectory IN LISTS subdirectories)
    boxstream_collect_threads_tests(${subdirectory})
  endforeach()
endfunction()

boxstream_collect_threads_tests(${PROJECT_SOURCE_DIR}/tests)
