// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <boxstream/function_ref.hpp>

namespace boxstream::detail {

class Tree;

/// What a tree needs to use more than one thread. Nothing that is found, and no order, depends on it.
class Team {
 public:
  virtual ~Team() = default;

  virtual std::size_t threads() const = 0;

  /// Calls `part(i)` once for each i < count, on any threads, and returns when all have returned.
  virtual void run_parts(std::size_t count, FunctionRef<void(std::size_t)> part) = 0;

  /// Children of a node, each done with a tree of its own; their pairs are passed on in their order. First
  /// `begin_children`, then `work_on_child` for each i < count on any threads, then `finish_children`, which does the
  /// rest and returns false when the search is to stop.
  virtual void begin_children(std::size_t count) = 0;
  virtual void work_on_child(std::size_t i, FunctionRef<bool(Tree&, std::size_t)> child) = 0;
  virtual bool finish_children(FunctionRef<bool(Tree&, std::size_t)> child) = 0;
};

/// Smaller nodes are left to one thread. A box takes at least 20 ns, so 16384 of them 0.33 ms; to wake a sleeping
/// thread takes 30 to 50 microseconds, and its caches are cold. Measured on two cores: at 17000 boxes the cheapest
/// batch gains nothing, others a third; at 24000 all gain.
constexpr std::size_t least_parallel_boxes = 16384;

/// Of a thread. Fewer take no longer than waking it, and scratch memory must not grow with threads that have nothing to
/// do.
constexpr std::size_t least_boxes_of_thread = 1024;

}  // namespace boxstream::detail
