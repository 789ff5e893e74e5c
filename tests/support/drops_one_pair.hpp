// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include <utility>

#include "formats/record/forwarding_broadphase.hpp"

namespace boxstream::tests {

/// A planted fault: takes a pair whose boxes overlap out of the cache after batch number `batch`, one in the middle of
/// those that have contacts, or of all if none has.
class DropsOnePair final : public record::ForwardingBroadphase {
 public:
  DropsOnePair(std::unique_ptr<btBroadphaseInterface> inner, int batch)
      : ForwardingBroadphase(std::move(inner)), batch_(batch) {}

  void calculateOverlappingPairs(btDispatcher* dispatcher) override {
    inner().calculateOverlappingPairs(dispatcher);
    if (++batches_ != batch_) return;
    btOverlappingPairCache& cache = *getOverlappingPairCache();
    const btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
    btBroadphasePairArray touching;
    for (int i = 0; i < pairs.size(); ++i)
      if (has_contacts(pairs[i])) touching.push_back(pairs[i]);
    const btBroadphasePair pair = touching.size() > 0 ? touching[touching.size() / 2] : pairs[pairs.size() / 2];
    cache.removeOverlappingPair(pair.m_pProxy0, pair.m_pProxy1, dispatcher);
  }

 private:
  static bool has_contacts(const btBroadphasePair& pair) {
    btManifoldArray manifolds;
    if (pair.m_algorithm != nullptr) pair.m_algorithm->getAllContactManifolds(manifolds);
    for (int i = 0; i < manifolds.size(); ++i)
      if (manifolds[i]->getNumContacts() > 0) return true;
    return false;
  }

  int batch_;
  int batches_ = 0;
};

}  // namespace boxstream::tests
