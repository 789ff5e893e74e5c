// SPDX-License-Identifier: MIT
#include "pair_orders/ordered.hpp"

#include <boxstream/bullet.hpp>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

namespace boxstream::report {
namespace {

class OrderedCache final : public btHashedOverlappingPairCache {
 public:
  OrderedCache(const PairOrder& order, const btVector3& gravity) : sorter_(order, gravity) {}

  using btHashedOverlappingPairCache::processAllOverlappingPairs;
  void processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher*, const btDispatcherInfo&) override {
    btBroadphasePair* const pairs = getOverlappingPairArrayPtr();
    const auto proxies = [&](std::size_t i) { return std::pair(pairs[i].m_pProxy0, pairs[i].m_pProxy1); };
    const auto count = static_cast<std::size_t>(getNumOverlappingPairs());
    // The dispatcher's callback, for which alone Bullet calls this, never asks for a pair to go.
    for (const std::uint32_t i : sorter_.sorted(count, proxies)) callback->processOverlap(pairs[i]);
  }

 private:
  PairSorter sorter_;
};

struct HasCache {
  OrderedCache cache;
};

class OrderedPairs final : private HasCache, public bullet::Broadphase {
 public:
  OrderedPairs(const PairOrder& order, const btVector3& gravity)
      : HasCache{{order, gravity}}, bullet::Broadphase(&cache) {}
};

}  // namespace

std::unique_ptr<btBroadphaseInterface> make_ordered_pairs(const PairOrder& order, const btVector3& gravity) {
  return std::make_unique<OrderedPairs>(order, gravity);
}

void OrderedSolver::convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) {
  const auto proxies = [&](std::size_t i) {
    const btBroadphaseProxy* const a = manifolds[i]->getBody0()->getBroadphaseHandle();
    const btBroadphaseProxy* const b = manifolds[i]->getBody1()->getBroadphaseHandle();
    return std::pair(a, b);
  };
  sorted_.clear();
  for (const std::uint32_t i : sorter_.sorted(static_cast<std::size_t>(count), proxies))
    sorted_.push_back(manifolds[i]);
  btSequentialImpulseConstraintSolver::convertContacts(sorted_.data(), count, info);
}

}  // namespace boxstream::report
