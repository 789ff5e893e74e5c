// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace boxstream::tool {

/// How far a run is, on standard error. On a terminal one line that is written over while it goes, and gone when it
/// ends; elsewhere a line for each tenth of the steps, if they take longer than two seconds.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// `done` of `all` steps are done. Cheap: most calls write nothing.
  void step(std::uint64_t done, std::uint64_t all, std::uint64_t bodies, std::uint64_t pairs);
  /// Run number `run` of `all` begins; `seconds_left` may be NaN. On a terminal at once; elsewhere the first, and then
  /// one each ten seconds.
  void run(std::size_t run, std::size_t all, double seconds_left, const std::string& what);
  /// Shows `text` at once, on a terminal.
  void say(const std::string& text);
  /// Leaves an empty line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  Clock::time_point begun_;
  Clock::time_point shown_;
  std::uint64_t tenths_ = 0;  // shown
  bool has_said_ = false;
};

}  // namespace boxstream::tool
