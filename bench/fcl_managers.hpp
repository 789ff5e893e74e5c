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

/// A manager and what one has to know to use it.
struct FclManagerKind {
  std::string name;
  std::unique_ptr<FclManager> (*make)(Span<const Aabb> boxes);
  bool candidates = false;            ///< it leaves telling pairs that touch from others to the callback
  bool partial_update = true;         ///< it can be told which objects moved
  bool lists_all = false;             ///< when all moved it is given the list of all, instead of none
  bool distances = true;              ///< its distance queries are safe to call
  const char* known_difference = "";  ///< why its pairs may differ, if that is known
};

/// Ours, then FCL's.
std::vector<FclManagerKind> fcl_manager_kinds();

}  // namespace boxstream::bench
