# SPDX-License-Identifier: MIT
# PROGRAM, of whose processes one ends, ends with an error and in time, under LAUNCHER.
execute_process(COMMAND ${LAUNCHER} -n 3 ${PROGRAM} TIMEOUT 60
  OUTPUT_VARIABLE printed ERROR_VARIABLE errors RESULT_VARIABLE code)
message("${code}\n${printed}\n${errors}")
if(NOT printed MATCHES "a rank ends" OR printed MATCHES "not reached" OR code EQUAL 0 OR code MATCHES "timeout")
  message(FATAL_ERROR "this is not how it should end")
endif()
