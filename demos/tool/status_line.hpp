// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace boxstream::tool {

/// One line on the terminal that is written over while a run goes, and gone when it ends. Writes nothing at all when
/// standard error is not a terminal.
class StatusLine {
 public:
  StatusLine();
  ~StatusLine();
  StatusLine(const StatusLine&) = delete;
  StatusLine& operator=(const StatusLine&) = delete;

  /// `done` of `all` steps are done. Cheap: most calls write nothing.
  void step(std::uint64_t done, std::uint64_t all, std::uint64_t bodies, std::uint64_t pairs);
  /// Shows `text` at once.
  void say(const std::string& text);
  /// Leaves an empty line.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  bool on_;
  Clock::time_point begun_;
  Clock::time_point shown_;
};

}  // namespace boxstream::tool
