// SPDX-License-Identifier: MIT
#include "simulation/run/pair_list.hpp"

#include <algorithm>

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

namespace boxstream::scenes {

void list_pairs(const btBroadphaseInterface& broadphase, std::vector<Pair>& out) {
  const btOverlappingPairCache& cache = *broadphase.getOverlappingPairCache();
  const int count = cache.getNumOverlappingPairs();
  const btBroadphasePair* const pairs = count > 0 ? cache.getOverlappingPairArrayPtr() : nullptr;
  out.clear();
  out.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const auto index = [](const btBroadphaseProxy* proxy) {
      return static_cast<std::uint32_t>(static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex());
    };
    const std::uint32_t a = index(pairs[i].m_pProxy0), b = index(pairs[i].m_pProxy1);
    out.push_back(a < b ? Pair{a, b} : Pair{b, a});
  }
  std::sort(out.begin(), out.end());
}

std::uint64_t count_missing(const std::vector<Pair>& list, const std::vector<Pair>& other) {
  std::uint64_t count = 0;
  auto there = other.begin();
  for (const Pair& pair : list) {
    while (there != other.end() && *there < pair) ++there;
    if (there == other.end() || *there != pair) ++count;
  }
  return count;
}

}  // namespace boxstream::scenes
