// SPDX-License-Identifier: MIT
#include "pair_orders/exact_pairs.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace boxstream::report {
namespace {

int number_of(const btBroadphaseProxy* proxy) {
  return static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
}

std::pair<int, int> numbers_of(const btBroadphasePair& pair) {
  return std::minmax(number_of(pair.m_pProxy0), number_of(pair.m_pProxy1));
}

bool goes_before(const btBroadphasePair& a, const btBroadphasePair& b) {
  return numbers_of(a) < numbers_of(b);
}

bool overlap(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  for (int d = 0; d < 3; ++d)
    if (!(a.m_aabbMin[d] <= b.m_aabbMax[d] && b.m_aabbMin[d] <= a.m_aabbMax[d])) return false;
  return true;
}

std::vector<btBroadphasePair> sorted(const btBroadphasePairArray& pairs) {
  std::vector<btBroadphasePair> all;
  for (int i = 0; i < pairs.size(); ++i) all.push_back(pairs[i]);
  std::sort(all.begin(), all.end(), goes_before);
  return all;
}

}  // namespace

ExactPairs::ExactPairs(std::unique_ptr<btBroadphaseInterface> inner) : ForwardingBroadphase(std::move(inner)) {}

void ExactPairs::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  pairs_.removeOverlappingPairsContainingProxy(proxy, dispatcher);
  ForwardingBroadphase::destroyProxy(proxy, dispatcher);
}

void ExactPairs::calculateOverlappingPairs(btDispatcher* dispatcher) {
  ForwardingBroadphase::calculateOverlappingPairs(dispatcher);
  std::vector<btBroadphasePair> found = sorted(inner().getOverlappingPairCache()->getOverlappingPairArray());
  std::erase_if(found, [](const btBroadphasePair& pair) { return !overlap(*pair.m_pProxy0, *pair.m_pProxy1); });
  std::vector<btBroadphasePair> held = sorted(pairs_.getOverlappingPairArray()), kept, begun, now;
  // Bullet's own removal from this cache swaps with an element beyond the end, so pairs leave by hand.
  for (btBroadphasePair& pair : held) {
    if (std::binary_search(found.begin(), found.end(), pair, goes_before))
      kept.push_back(pair);
    else
      pairs_.cleanOverlappingPair(pair, dispatcher);
  }
  std::set_difference(found.begin(), found.end(), held.begin(), held.end(), std::back_inserter(begun), goes_before);
  std::merge(kept.begin(), kept.end(), begun.begin(), begun.end(), std::back_inserter(now), goes_before);
  btBroadphasePairArray& array = pairs_.getOverlappingPairArray();
  array.resize(0);
  for (const btBroadphasePair& pair : now) array.push_back(pair);
}

}  // namespace boxstream::report
