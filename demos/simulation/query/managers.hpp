// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>

#include <memory>
#include <string>

namespace boxstream::query {

using Manager = ::fcl::BroadPhaseCollisionManager<double>;

/// What some managers need: where objects are expected, how large they are on average, how much farther apart
/// than touching they still pair.
struct Extent {
  ::fcl::AABB<double> all;
  double mean_side = 1;
  std::size_t objects = 1;
  double margin = 0;
};

/// One of manager_names(): boxstream; boxstream_tight, which makes its own boxes; FCL's own: tree, tree_array, ssap,
/// sap, interval, hash, naive.
std::unique_ptr<Manager> make_manager(const std::string& name, const Extent& extent);

/// False for managers whose update of a list of objects does not end.
bool updates_lists(const std::string& name);

}  // namespace boxstream::query
