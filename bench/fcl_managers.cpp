// SPDX-License-Identifier: MIT
#include "fcl_managers.hpp"

#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>

#include <boxstream/fcl.hpp>

#include "peers/fcl_peer.hpp"

namespace boxstream::bench {

namespace {

template <class Manager>
std::unique_ptr<FclManager> make(Span<const Aabb>) {
  return std::make_unique<Manager>();
}

const char* const tolerance = "update skips a box that moved by less than a relative tolerance";
const char* const strict = "compares strictly, so it misses boxes that only touch";

}  // namespace

std::vector<FclManagerKind> fcl_manager_kinds() {
  using namespace ::fcl;
  using Tree = DynamicAABBTreeCollisionManager<double>;
  std::vector<FclManagerKind> kinds;
  kinds.push_back({"ours", make<boxstream::fcl::CollisionManager<double>>});
  kinds.push_back({"fcl-tree", make<Tree>});
  kinds.back().known_difference = tolerance;
  kinds.push_back(kinds.back());
  kinds.back().name = "fcl-tree-listed";
  kinds.back().lists_all = true;
  kinds.push_back({"fcl-tree-array", make<DynamicAABBTreeCollisionManager_Array<double>>});
  kinds.back().known_difference = tolerance;
  kinds.push_back({"fcl-ssap", make<SSaPCollisionManager<double>>});
  kinds.push_back({"fcl-sap", make<SaPCollisionManager<double>>});
  kinds.back().known_difference = strict;
  // Where ends coincide it pairs boxes that are apart, and its update of some objects searches until the stack is full.
  kinds.push_back({"fcl-interval-tree", make<IntervalTreeCollisionManager<double>>});
  kinds.back().candidates = true;
  kinds.back().partial_update = false;
  kinds.back().known_difference = strict;
  kinds.push_back({"fcl-hash", make_fcl_hash});
  kinds.back().candidates = true;
  kinds.back().known_difference = "misses boxes that touch where two of its cells meet";
  kinds.push_back({"fcl-naive", make<NaiveCollisionManager<double>>});
  kinds.back().candidates = true;
  return kinds;
}

}  // namespace boxstream::bench
