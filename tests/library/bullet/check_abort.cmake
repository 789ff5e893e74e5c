# SPDX-License-Identifier: MIT
# Runs PROGRAM; passes if it is killed by abort() and its standard error is one line that contains MESSAGE.
execute_process(COMMAND ${PROGRAM} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE error)
if(NOT result MATCHES "abort|Abort|134|SIGABRT")
  message(FATAL_ERROR "expected abort(), got '${result}', output '${output}', error '${error}'")
endif()
string(STRIP "${error}" line)
string(FIND "${line}" "${MESSAGE}" at)
if(at EQUAL -1 OR line MATCHES "\n")
  message(FATAL_ERROR "expected one line with '${MESSAGE}', got '${error}'")
endif()
