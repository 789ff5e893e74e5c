// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

namespace boxstream::report::narrow {

/// Thrown by an engine that reports its own result as unreliable.
class Unsure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Answer {
  enum class How : std::uint8_t { none, answered, unsure, threw, aborted, crashed, no_end };
  How how = How::none;
  double value = 0;  ///< if it was answered
};

/// Calls `ask(i)` for all i below `count` in child processes, since queries may abort, crash or never end: a
/// process that ends is followed by another that continues after the query. A query has `seconds` of processor time.
/// Output of children to stderr is dropped. Not for processes with threads that hold locks.
std::vector<Answer> ask_in_child(std::size_t count, double seconds, const std::function<double(std::size_t)>& ask);

}  // namespace boxstream::report::narrow
