// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <utility>
#include <vector>

#include <fcl/broadphase/broadphase_collision_manager.h>
#include <boxstream/function_ref.hpp>

#include "backend.hpp"

namespace boxstream::preload {

using Object = ::fcl::CollisionObject<double>;
using OnCollide = ::fcl::CollisionCallBack<double>;
using OnDistance = ::fcl::DistanceCallBack<double>;
using Pairs = std::vector<std::pair<Object*, Object*>>;

/// The pairs of a query, in the order in which they are called back.
struct Found {
  Pairs pairs;
  static bool note(Object* a, Object* b, void* to);
};

/// The least distance of boxes that a query comes upon.
struct Nearest {
  double distance = std::numeric_limits<double>::max();
  Object* a = nullptr;
  Object* b = nullptr;
  static bool note(Object* a, Object* b, void* to, double& distance);
};

/// Compares the sets of pairs of two ways to ask the same, and returns those of FCL's own manager without the pairs of
/// an object with itself, which some of FCL's managers report.
Pairs check_pairs(const Front& front, FunctionRef<void(Found&)> own, FunctionRef<void(Found&)> ours);

/// Compares the least distances between boxes, which are exactly the same if both are right.
void check_distance(const Front& front, FunctionRef<void(Nearest&)> own, FunctionRef<void(Nearest&)> ours);

}  // namespace boxstream::preload
