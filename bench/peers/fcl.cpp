// SPDX-License-Identifier: MIT
#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>

#include <algorithm>

#include "peers/fcl_peer.hpp"

namespace boxstream::bench {

/// Cells of two mean sides, a table with a place for each box: what suits boxes of similar sizes. The scene has room to
/// move, because objects beyond its limit are held against all others.
std::unique_ptr<::fcl::BroadPhaseCollisionManager<double>> make_fcl_hash(Span<const Aabb> boxes) {
  Aabb all = boxes.empty() ? Aabb{} : boxes[0];
  double sides = 0;
  for (const Aabb& box : boxes) {
    all = merged(all, box);
    for (int d = 0; d < 3; ++d) sides += static_cast<double>(box.max[d]) - static_cast<double>(box.min[d]);
  }
  const double mean = sides / (3 * std::max(1.0, static_cast<double>(boxes.size())));
  const ::fcl::Vector3<double> low(all.min[0], all.min[1], all.min[2]), high(all.max[0], all.max[1], all.max[2]);
  const ::fcl::Vector3<double> room = 0.25 * (high - low);
  return std::make_unique<::fcl::SpatialHashingCollisionManager<double>>(
      mean > 0 ? 2 * mean : 1.0, low - room, high + room,
      static_cast<unsigned>(std::max<std::size_t>(1, boxes.size())));
}

namespace {

const char* const tolerance = "update skips a box that moved by less than a relative tolerance";
const char* const strict = "compares strictly, so it misses boxes that only touch";

}  // namespace

std::vector<PeerConfig> make_fcl_peers() {
  using namespace ::fcl;
  std::vector<PeerConfig> peers;
  const auto add = [&peers](const char* name, const char* known_difference, FclPeer<double>::Make make,
                            FclPeer<double>::Ways ways = {false, true}) {
    peers.push_back({name, name, 1, known_difference, std::make_unique<FclPeer<double>>(make, ways)});
  };
  peers.push_back({"fcl-tree-float", "fcl-tree-float", 1, tolerance, make_fcl_float_tree()});
  add("fcl-tree", tolerance, make_fcl_manager<double, DynamicAABBTreeCollisionManager>);
  add("fcl-tree-array", tolerance, make_fcl_manager<double, DynamicAABBTreeCollisionManager_Array>);
  add("fcl-ssap", "", make_fcl_manager<double, SSaPCollisionManager>);
  add("fcl-sap", strict, make_fcl_manager<double, SaPCollisionManager>);
  // Where ends coincide it pairs boxes that are apart, and its update of some objects searches until the stack is full.
  add("fcl-interval-tree", strict, make_fcl_manager<double, IntervalTreeCollisionManager>, {true, false});
  add("fcl-hash", "misses boxes that touch where two of its cells meet", make_fcl_hash, {true, true});
  return peers;
}

}  // namespace boxstream::bench
