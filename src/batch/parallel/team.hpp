// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>

#include "base/thresholds.hpp"

namespace boxstream::detail {

class WideTree;

/// What a tree needs to use more than one thread. Nothing that is found, and no order, depends on it.
class Team {
 public:
  virtual ~Team() = default;

  virtual std::size_t threads() const = 0;

  /// Nodes of fewer boxes are left to one thread.
  virtual std::size_t least_boxes() const = 0;

  /// Calls `part(i)` once for each i < count, on any threads, and returns when all have returned.
  virtual void run_parts(std::size_t count, FunctionRef<void(std::size_t)> part) = 0;

  /// Children of a node, each done with a tree of its own; their pairs are passed on in their order. First
  /// `begin_children`, then `work_on_child` for each i < count on any threads, then `finish_children`, which does the
  /// rest and returns false when the search is to stop.
  virtual void begin_children(std::size_t count) = 0;
  virtual void work_on_child(std::size_t i, FunctionRef<bool(WideTree&, std::size_t)> child) = 0;
  virtual bool finish_children(FunctionRef<bool(WideTree&, std::size_t)> child) = 0;
};

/// Nodes of fewer boxes are left to one thread, where others take that long to start. A box takes at least 20 ns, so
/// that in the 50 microseconds in which a sleeping thread wakes up one thread does 2500 of them; the caches of the
/// other are cold then. Measured on two cores: with 17000 boxes and sleeping threads the cheapest batch gains nothing,
/// others a third; with 24000 all gain.
inline std::size_t least_parallel_boxes(std::uint32_t start_nanoseconds) {
  constexpr std::uint64_t boxes = thresholds.boxes_of_sleepers, nanoseconds = 50000;
  return std::max(2 * thresholds.boxes_of_thread, static_cast<std::size_t>(start_nanoseconds * boxes / nanoseconds));
}

/// Of work on many boxes: how many threads have enough to do, and of how many boxes a part is shared.
struct Sharing {
  std::size_t threads = 1;
  std::size_t least_boxes = 0;
};

/// `executor` may be null. It is not asked where the boxes are too few however soon its threads start.
inline Sharing sharing_for(Executor* executor, std::uint64_t boxes) {
  if (executor == nullptr || boxes < least_parallel_boxes(0)) return {};
  const std::size_t least = least_parallel_boxes(executor->start_nanoseconds());
  if (boxes < least) return {};
  const std::uint64_t threads = std::max<std::size_t>(1, executor->concurrency());
  const auto most = std::min<std::uint64_t>(threads, boxes / thresholds.boxes_of_thread);
  return {static_cast<std::size_t>(most), least};
}

}  // namespace boxstream::detail
