// SPDX-License-Identifier: MIT
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include "peers/fcl_peer.hpp"

namespace boxstream::bench {

std::unique_ptr<Peer> make_fcl_float_tree() {
  return std::make_unique<FclPeer<float>>(make_fcl_manager<float, ::fcl::DynamicAABBTreeCollisionManager>,
                                          FclPeer<float>::Ways{});
}

}  // namespace boxstream::bench
