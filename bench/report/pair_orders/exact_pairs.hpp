// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <memory>

#include "formats/record/forwarding_broadphase.hpp"

namespace boxstream::report {

/// Any broad-phase, with a pair cache that makes all of them indistinguishable for the engine: after each
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
  /// An array of pairs in any order. Bullet's class defers removals by default.
  struct Cache final : btSortedOverlappingPairCache {
    Cache() { m_hasDeferredRemoval = false; }
  };
  Cache pairs_;
};

}  // namespace boxstream::report
