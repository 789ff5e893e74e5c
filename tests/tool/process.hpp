// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::tool_test {

struct Outcome {
  int exit_code = -1;  // 128 + signal if it was killed
  std::string out;
  std::string err;
};

struct RunOptions {
  std::string input;
  /// Standard error is a terminal (a pseudo-terminal) in place of a pipe.
  bool terminal = false;
  /// Processor time after which it is killed by SIGXCPU; 0: none.
  unsigned cpu_seconds = 0;
};

/// Runs a program to its end. It leaves no core file.
Outcome run_program(const std::string& program, const std::vector<std::string>& arguments,
                    const RunOptions& options = {});

/// Runs the boxstream command to its end.
Outcome run_tool(const std::vector<std::string>& arguments, const RunOptions& options = {});

}  // namespace boxstream::tool_test
