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

  /// Does children [first, last) of a node, each with a tree of its own, and passes their pairs on in their order.
  /// False when the search is to stop.
  virtual bool run_children(std::size_t first, std::size_t last, FunctionRef<bool(Tree&, std::size_t)> child) = 0;
};

/// Below, handing out work costs more than other threads save.
constexpr std::size_t least_parallel_boxes = 16384;

}  // namespace boxstream::detail
