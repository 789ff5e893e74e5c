// SPDX-License-Identifier: MIT
#include "borrowed_cache.hpp"

#include "fatal.hpp"
#include "proxy.hpp"

namespace boxstream::bullet::inline BOXSTREAM_BULLET_PRECISION {
namespace {

struct Probe final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return true; }
};

}  // namespace

bool keeps_pairs(btOverlappingPairCache& cache) {
  Probe probe;
  btOverlapFilterCallback* const before = cache.getOverlapFilterCallback();
  cache.setOverlapFilterCallback(&probe);
  const bool keeps = cache.getOverlapFilterCallback() == &probe;
  cache.setOverlapFilterCallback(before);
  return keeps;
}

void remove_deferred(btOverlappingPairCache& cache, const BasicWorld<btScalar>& world, btDispatcher* dispatcher) {
  const auto world_box = [&](const btBroadphaseProxy* proxy) {
    return world.box(static_cast<const Proxy*>(proxy)->id);
  };
  btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  pairs.quickSort(btBroadphasePairSortPredicate());
  int kept = 0;
  for (int i = 0; i < pairs.size(); ++i) {
    btBroadphasePair& pair = pairs[i];
    const bool repeated =
        kept > 0 && pairs[kept - 1].m_pProxy0 == pair.m_pProxy0 && pairs[kept - 1].m_pProxy1 == pair.m_pProxy1;
    const auto a = world_box(pair.m_pProxy0), b = world_box(pair.m_pProxy1);
    if (!repeated && is_valid(a) && is_valid(b) && overlaps(a, b)) {
      if (kept != i) pairs[kept] = pair;
      ++kept;
    } else if (dispatcher) {
      cache.cleanOverlappingPair(pair, dispatcher);
    }
  }
  pairs.resizeNoInitialize(kept);
}

void require_room(const btOverlappingPairCache& cache, std::size_t more) {
  // They count in int and double their capacity.
  if (std::size_t(cache.getNumOverlappingPairs()) + more >= std::size_t{1} << 30)
    fatal("2^30 pairs overlap, more than Bullet's pair arrays can hold");
}

}  // namespace boxstream::bullet::inline BOXSTREAM_BULLET_PRECISION
