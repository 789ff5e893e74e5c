// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace boxstream::tool {

/// Whether what is written there goes to a terminal that can move its cursor. `descriptor` as of isatty.
bool is_terminal(int descriptor);

/// Whether it shows colours, too, and its user wants them: NO_COLOR (no-color.org) is not set.
bool shows_colours(int descriptor);

/// Text for reading, to standard output: only line breaks steer the terminal. Throws std::runtime_error if not all of
/// it could be written.
void print(const std::string& text);

/// The same of text for programs, as it is.
void print_raw(const std::string& text);

/// Help, likewise; on a terminal that shows colours its headings are bold.
void print_help(const std::string& text);

/// The same to standard error, "boxstream: " in front, on one line; never throws.
void remark(const std::string& text) noexcept;

/// remark() of what went wrong: its beginning is red on a terminal that shows colours.
void complain(const std::string& text) noexcept;

/// "12 345 678".
std::string grouped(std::uint64_t number);

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
