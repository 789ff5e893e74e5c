// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/broadphase/broadphase_collision_manager.h>

#include <memory>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

using FclManager = ::fcl::BroadPhaseCollisionManager<double>;

/// A manager, and how it is used.
struct FclManagerKind {
  std::string name;
  std::unique_ptr<FclManager> (*make)(Span<const Aabb> boxes);  ///< some managers depend on the extent of the boxes
  bool candidates = false;                                      ///< it also calls back for pairs that do not touch
  bool partial_update = true;                                   ///< it takes a list of the objects that moved
  bool lists_all = false;             ///< when all moved it is given the list of all, instead of none
  const char* known_difference = "";  ///< why its pairs may differ, if that is known
  const char* crashes_at = "";        ///< see PeerConfig
};

/// FCL's.
std::vector<FclManagerKind> fcl_own_manager_kinds();

/// Ours, ours by the paper's tree, then FCL's. Present only where our adapter is.
std::vector<FclManagerKind> fcl_manager_kinds();

}  // namespace boxstream::bench
