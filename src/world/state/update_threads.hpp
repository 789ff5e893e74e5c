// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>

#include <boxstream/executor.hpp>

#include "base/even_parts.hpp"
#include "base/thresholds.hpp"
#include "batch/parallel/team.hpp"
#include "batch/parallel/thrown.hpp"

namespace boxstream::detail {

/// The threads of an Executor, for phases of an update that do the same with each of many elements, in order.
class UpdateThreads {
 public:
  explicit UpdateThreads(Executor* executor) : executor_(executor) {}

  /// To be called at the beginning of an update of that many boxes.
  void begin_update(std::size_t boxes) { sharing_ = sharing_for(executor_, boxes); }

  /// How many threads a search of all boxes may use.
  std::size_t count() const { return sharing_.threads; }

  /// Into how many parts to divide that many elements.
  std::size_t parts(std::size_t things) const {
    if (sharing_.threads == 1 || things < thresholds.things_of_box * sharing_.least_boxes) return 1;
    return std::min(sharing_.threads, things / (thresholds.things_of_box * thresholds.boxes_of_thread));
  }

  /// Calls `part(i)` for each i < `parts`, which are more than one. What the first of them throws, or the executor, is
  /// thrown when all have returned; an executor that leaves parts out ends in std::logic_error.
  void run(std::size_t parts, FunctionRef<void(std::size_t)> part) const {
    assert(parts > 1 && executor_ != nullptr);
    run_parts(*executor_, parts, part);
  }

 private:
  Executor* executor_;
  Sharing sharing_;
};

}  // namespace boxstream::detail
