// SPDX-License-Identifier: MIT
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include "peers/fcl_peer.hpp"

namespace boxstream::bench {

std::unique_ptr<Peer> make_fcl_float_tree() {
  const auto make = [](Span<const Aabb>) -> std::unique_ptr<FclPeer<float>::Manager> {
    return std::make_unique<::fcl::DynamicAABBTreeCollisionManager<float>>();
  };
  return std::make_unique<FclPeer<float>>(make, false, true);
}

}  // namespace boxstream::bench
