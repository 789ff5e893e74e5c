// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
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
  /// Where it runs; empty: where the test does.
  std::string directory = {};
  /// Mebibytes of addresses after which it gets no more; 0: none.
  unsigned mebibytes = 0;
  /// Runs while the program does, and is told the number of its process.
  std::function<void(int)> meanwhile = {};
};

/// Runs a program to its end. It leaves no core file.
Outcome run_program(const std::string& program, const std::vector<std::string>& arguments,
                    const RunOptions& options = {});

/// What a run said on standard error, without lines that depend on how busy the machine is: how far the run is, and
/// that it had to wait.
std::string lasting_words(const Outcome& outcome);

/// The boxstream command.
std::string tool_program();

/// Runs the boxstream command to its end.
Outcome run_tool(const std::vector<std::string>& arguments, const RunOptions& options = {});

}  // namespace boxstream::tool_test
