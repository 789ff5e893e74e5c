# SPDX-License-Identifier: MIT
# Test programs for CTest.
include(GoogleTest)

# As gtest_discover_tests: a test of CTest for each of the program's tests. TOGETHER, where they are rows of long tables,
# and under sanitizers and on emulated systems, four for each program, a quarter of its tests each: starting a program
# takes longer than most tests do. On the latter two, where RapidCheck draws cases, a quarter of these. It draws the same
# in each run, so that no change fails by chance; a program that is run by hand draws others.
function(boxstream_discover_tests program)
  cmake_parse_arguments(PARSE_ARGV 1 arg "TOGETHER" "TEST_PREFIX;DISCOVERY_MODE;WORKING_DIRECTORY" "PROPERTIES")
  set(slow_to_start NO)
  if(BOXSTREAM_SANITIZE OR CMAKE_CROSSCOMPILING)
    set(slow_to_start YES)
  endif()
  set(cases seed=1)
  if(NOT arg_TOGETHER AND NOT slow_to_start)
    string(REPLACE ";PROPERTIES;" ";PROPERTIES;ENVIRONMENT_MODIFICATION;RC_PARAMS=set:${cases};" given "${ARGV}")
    gtest_discover_tests(${given})
    return()
  endif()
  if(NOT arg_WORKING_DIRECTORY)
    set(arg_WORKING_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR})
  endif()
  if(slow_to_start)
    string(APPEND cases " max_success=25")
  endif()
  foreach(quarter RANGE 3)
    set(test ${arg_TEST_PREFIX}${program}.${quarter})
    add_test(NAME ${test} COMMAND ${program} --gtest_brief=1 WORKING_DIRECTORY ${arg_WORKING_DIRECTORY})
    set_tests_properties(${test} PROPERTIES ${arg_PROPERTIES})
    set_tests_properties(${test} PROPERTIES TIMEOUT 1500)
    if(program MATCHES "_threads_tests?$")
      set_property(TEST ${test} APPEND PROPERTY LABELS threads)
    endif()
    set_property(TEST ${test} APPEND PROPERTY ENVIRONMENT GTEST_TOTAL_SHARDS=4 GTEST_SHARD_INDEX=${quarter}
      "RC_PARAMS=${cases}")
  endforeach()
endfunction()
