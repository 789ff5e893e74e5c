// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <memory>

#include "record/forwarding_broadphase.hpp"

namespace boxstream::report {

/// Any broad-phase, with a pair cache that leaves the engine no way to tell which one it is: after each
/// calculateOverlappingPairs it holds the pairs that the other one found and whose boxes overlap (closed), ordered by
/// the user indices of their objects; pairs end before others begin, both in that order. For worlds of rigid bodies
/// without ghosts.
class ExactPairs final : public record::ForwardingBroadphase {
 public:
  explicit ExactPairs(std::unique_ptr<btBroadphaseInterface> inner);

  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  void calculateOverlappingPairs(btDispatcher* dispatcher) override;
  btOverlappingPairCache* getOverlappingPairCache() override { return &pairs_; }
  const btOverlappingPairCache* getOverlappingPairCache() const override { return &pairs_; }

 private:
  /// An array of pairs in any order. Bullet's class puts removals off unless it is told not to.
  struct Cache final : btSortedOverlappingPairCache {
    Cache() { m_hasDeferredRemoval = false; }
  };
  Cache pairs_;
};

}  // namespace boxstream::report
