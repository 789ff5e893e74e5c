// SPDX-License-Identifier: MIT
#include "borrowed_cache.hpp"

#include <cstring>
#include <vector>

#include <boxstream/detail/float_environment.hpp>

#include "fatal.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

bool overlap_in(const BasicWorld<btScalar>& world, const btBroadphasePair& pair) {
  const auto a = world.box(static_cast<const Proxy*>(pair.m_pProxy0)->id);
  const auto b = world.box(static_cast<const Proxy*>(pair.m_pProxy1)->id);
  const boxstream::detail::DefaultFloatEnvironment environment;
  return is_valid(a) && is_valid(b) && overlaps(a, b);
}

}  // namespace

bool keeps_pairs(const btOverlappingPairCache& cache) {
  // What an object with virtual functions begins with, in every ABI that Bullet runs on.
  const auto class_of = [](const btOverlappingPairCache& object) {
    const void* table;
    std::memcpy(&table, static_cast<const void*>(&object), sizeof(table));
    return table;
  };
  const btNullPairCache null_cache;
  return class_of(cache) != class_of(null_cache);
}

void remove_deferred(btOverlappingPairCache& cache, const BasicWorld<btScalar>& world, btDispatcher* dispatcher) {
  btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  pairs.quickSort(btBroadphasePairSortPredicate());
  int kept = 0;
  for (int i = 0; i < pairs.size(); ++i) {
    btBroadphasePair& pair = pairs[i];
    const bool repeated =
        kept > 0 && pairs[kept - 1].m_pProxy0 == pair.m_pProxy0 && pairs[kept - 1].m_pProxy1 == pair.m_pProxy1;
    if (!repeated && overlap_in(world, pair)) {
      if (kept != i) pairs[kept] = pair;
      ++kept;
    } else if (dispatcher) {
      cache.cleanOverlappingPair(pair, dispatcher);
    }
  }
  pairs.resizeNoInitialize(kept);
}

void reconcile(btOverlappingPairCache& cache, CacheSnapshot& snapshot, BasicWorld<btScalar>& world,
               btDispatcher* dispatcher) {
  std::vector<CacheSnapshot::Entry> lost, gained;
  snapshot.capture(cache, lost, gained);
  if (lost.empty() && gained.empty()) return;
  for (const auto* changed : {&lost, &gained})
    for (const CacheSnapshot::Entry& pair : *changed)
      world.release(static_cast<const Proxy*>(pair.first)->id, static_cast<const Proxy*>(pair.second)->id);
  if (cache.hasDeferredRemoval()) {
    remove_deferred(cache, world, dispatcher);
  } else {
    for (const CacheSnapshot::Entry& pair : gained)
      if (!overlap_in(world, {*pair.first, *pair.second}))
        cache.removeOverlappingPair(pair.first, pair.second, dispatcher);
  }
  snapshot.capture(cache);  // removing changes places
}

void require_room(const btOverlappingPairCache& cache, std::size_t more) {
  // They count in int and double their capacity.
  if (std::size_t(cache.getNumOverlappingPairs()) + more >= std::size_t{1} << 30)
    fatal("2^30 pairs overlap, more than Bullet's pair arrays can hold");
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
