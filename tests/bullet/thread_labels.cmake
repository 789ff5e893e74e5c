# SPDX-License-Identifier: MIT
foreach(tests IN ITEMS bullet_threads_tests_TESTS bullet_float64_threads_tests_TESTS)
  if(${tests})
    set_tests_properties(${${tests}} PROPERTIES LABELS "bullet;threads")
  endif()
endforeach()
