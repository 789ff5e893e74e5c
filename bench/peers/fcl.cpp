// SPDX-License-Identifier: MIT
#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>

#include <algorithm>

#include "peers/fcl_managers.hpp"
#include "peers/fcl_peer.hpp"

namespace boxstream::bench {

namespace {

template <class Manager>
std::unique_ptr<FclManager> make(Span<const Aabb>) {
  return std::make_unique<Manager>();
}

/// Cells of two mean sides, a table with a place for each box: what suits boxes of similar sizes. The scene has room to
/// move, because objects beyond its limit are compared with all others.
std::unique_ptr<FclManager> make_fcl_hash(Span<const Aabb> boxes) {
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

const char* const tolerance = "update skips a box that moved by less than a relative tolerance";
const char* const strict = "compares strictly, so it misses boxes that only touch";

}  // namespace

std::vector<FclManagerKind> fcl_own_manager_kinds() {
  using namespace ::fcl;
  using Tree = DynamicAABBTreeCollisionManager<double>;
  // Where ends coincide the interval tree pairs boxes that do not touch, and its update of some objects recurses until
  // the stack is full. SaP's update of boxes that tremble runs past the end of its lists.
  return {
      {.name = "fcl-tree", .make = make<Tree>, .known_difference = tolerance},
      {.name = "fcl-tree-listed", .make = make<Tree>, .lists_all = true, .known_difference = tolerance},
      {.name = "fcl-tree-array",
       .make = make<DynamicAABBTreeCollisionManager_Array<double>>,
       .known_difference = tolerance},
      {.name = "fcl-ssap", .make = make<SSaPCollisionManager<double>>},
      {.name = "fcl-sap",
       .make = make<SaPCollisionManager<double>>,
       .known_difference = strict,
       .crashes_at = "tremble"},
      {.name = "fcl-interval-tree",
       .make = make<IntervalTreeCollisionManager<double>>,
       .candidates = true,
       .partial_update = false,
       .known_difference = strict},
      {.name = "fcl-hash",
       .make = make_fcl_hash,
       .candidates = true,
       .known_difference = "misses boxes that touch where two of its cells meet"},
      {.name = "fcl-naive", .make = make<NaiveCollisionManager<double>>, .candidates = true},
  };
}

std::vector<PeerConfig> make_fcl_peers() {
  std::vector<PeerConfig> peers;
  peers.push_back({"fcl-tree-float", "fcl-tree-float", 1, tolerance, make_fcl_float_tree()});
  for (const FclManagerKind& kind : fcl_own_manager_kinds())
    if (!kind.lists_all && kind.name != "fcl-naive")
      peers.push_back({kind.name, kind.name, 1, kind.known_difference,
                       std::make_unique<FclPeer<double>>(kind.make, kind.candidates, kind.partial_update),
                       kind.crashes_at});
  return peers;
}

}  // namespace boxstream::bench
