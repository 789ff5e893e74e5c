# SPDX-License-Identifier: MIT
# Runs PROGRAM, by LAUNCHER if there is one, and wants what it prints to be the contents of EXPECTED; with RECORD it
# writes them instead.
separate_arguments(LAUNCHER)
execute_process(COMMAND ${LAUNCHER} ${PROGRAM} OUTPUT_VARIABLE printed RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${code}")
endif()
message("${printed}")
if(RECORD)
  file(WRITE ${EXPECTED} "${printed}")
  return()
endif()
file(READ ${EXPECTED} expected)
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "expected:\n${expected}")
endif()
