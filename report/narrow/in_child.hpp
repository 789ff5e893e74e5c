// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

namespace boxstream::report::narrow {

/// Thrown by what knows that its answer is not good enough.
class Unsure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Answer {
  enum class How : std::uint8_t { none, answered, unsure, threw, aborted, crashed, no_end };
  How how = How::none;
  double value = 0;  ///< if it was answered
};

/// Calls `ask(i)` for all i below `count` in child processes, since what is asked may abort, crash or loop for ever:
/// the process that dies is followed by another that goes on behind the question. A question has `seconds` of processor
/// time. What children print to stderr is dropped. Not for processes with threads that hold locks.
std::vector<Answer> ask_in_child(std::size_t count, double seconds, const std::function<double(std::size_t)>& ask);

}  // namespace boxstream::report::narrow
