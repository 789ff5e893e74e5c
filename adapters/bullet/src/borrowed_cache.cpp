// SPDX-License-Identifier: MIT
#include "borrowed_cache.hpp"

#include <vector>

#include <boxstream/detail/float_environment.hpp>

#include "fatal.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

struct Probe final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy*, btBroadphaseProxy*) const override { return true; }
};

bool overlap_in(const BasicWorld<btScalar>& world, const btBroadphasePair& pair) {
  const auto a = world.box(static_cast<const Proxy*>(pair.m_pProxy0)->id);
  const auto b = world.box(static_cast<const Proxy*>(pair.m_pProxy1)->id);
  const boxstream::detail::DefaultFloatEnvironment environment;
  return is_valid(a) && is_valid(b) && overlaps(a, b);
}

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

void reconcile(btOverlappingPairCache& cache, BasicWorld<btScalar>& world, btDispatcher* dispatcher) {
  const auto proxy_of = [&](ProxyId id) { return reinterpret_cast<Proxy*>(world.user(id)); };
  std::vector<ProxyPair> lost;
  world.for_each_pair([&](ProxyPair pair) {
    const bool live = world.contains(pair.a) && world.contains(pair.b);
    if (live && !cache.findPair(proxy_of(pair.a), proxy_of(pair.b))) lost.push_back(pair);
    return true;
  });
  for (const ProxyPair& pair : lost) world.release(pair.a, pair.b);

  if (cache.hasDeferredRemoval()) {
    remove_deferred(cache, world, dispatcher);
    return;
  }
  std::vector<btBroadphasePair> apart;
  const btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i)
    if (!overlap_in(world, pairs[i])) apart.push_back(pairs[i]);
  for (const btBroadphasePair& pair : apart) cache.removeOverlappingPair(pair.m_pProxy0, pair.m_pProxy1, dispatcher);
}

std::uint64_t digest(const btBroadphasePair& pair) {
  std::uint64_t mixed = reinterpret_cast<std::uintptr_t>(pair.m_pProxy0) * 0x9e3779b97f4a7c15u +
                        reinterpret_cast<std::uintptr_t>(pair.m_pProxy1) * 0xd1b54a32d192ed03u;
  mixed = (mixed ^ mixed >> 32) * 0xaf251af3b0f025b5u;
  return mixed ^ mixed >> 29;
}

std::uint64_t digest_of_all(const btOverlappingPairCache& cache) {
  if (cache.getNumOverlappingPairs() == 0) return 0;  // an empty array has no address to ask for
  const btBroadphasePair* const pairs = cache.getOverlappingPairArrayPtr();
  std::uint64_t sum = 0;
  for (int i = 0, count = cache.getNumOverlappingPairs(); i < count; ++i) sum += digest(pairs[i]);
  return sum;
}

std::uint64_t digest_of(const btOverlappingPairCache& cache, const btBroadphaseProxy& proxy) {
  if (cache.getNumOverlappingPairs() == 0) return 0;
  const btBroadphasePair* const pairs = cache.getOverlappingPairArrayPtr();
  std::uint64_t sum = 0;
  for (int i = 0, count = cache.getNumOverlappingPairs(); i < count; ++i)
    if (pairs[i].m_pProxy0 == &proxy || pairs[i].m_pProxy1 == &proxy) sum += digest(pairs[i]);
  return sum;
}

void require_room(const btOverlappingPairCache& cache, std::size_t more) {
  // They count in int and double their capacity.
  if (std::size_t(cache.getNumOverlappingPairs()) + more >= std::size_t{1} << 30)
    fatal("2^30 pairs overlap, more than Bullet's pair arrays can hold");
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
