// SPDX-License-Identifier: MIT
#include "ordered_pairs.hpp"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>

#include <algorithm>
#include <tuple>

namespace boxstream::worlds_test {

bool goes_before(const btBroadphasePair& a, const btBroadphasePair& b) {
  return std::make_tuple(a.m_pProxy0->m_uniqueId, a.m_pProxy1->m_uniqueId) <
         std::make_tuple(b.m_pProxy0->m_uniqueId, b.m_pProxy1->m_uniqueId);
}

void OrderedPairs::batch(const std::vector<btBroadphasePair>& overlapping, btDispatcher* dispatcher) {
  sort();
  std::vector<btBroadphasePair> kept, begun, ended;
  int held = 0;
  for (const btBroadphasePair& pair : overlapping) {
    for (; held < pairs_.size() && goes_before(pairs_[held], pair); ++held) ended.push_back(pairs_[held]);
    if (held < pairs_.size() && !goes_before(pair, pairs_[held]))
      kept.push_back(pairs_[held++]);
    else if (needsBroadphaseCollision(pair.m_pProxy0, pair.m_pProxy1))
      begun.push_back(pair);
  }
  for (; held < pairs_.size(); ++held) ended.push_back(pairs_[held]);
  std::vector<btBroadphasePair> now(kept.size() + begun.size());
  std::merge(kept.begin(), kept.end(), begun.begin(), begun.end(), now.begin(), goes_before);
  pairs_.resize(static_cast<int>(now.size()));
  for (std::size_t i = 0; i < now.size(); ++i) pairs_[static_cast<int>(i)] = now[i];
  for (btBroadphasePair& pair : ended) finish(pair, dispatcher);
  if (ghosts_ == nullptr) return;
  for (const btBroadphasePair& pair : begun) ghosts_->addOverlappingPair(pair.m_pProxy0, pair.m_pProxy1);
}

void OrderedPairs::sort() {
  if (pairs_.size() > 0) std::sort(&pairs_[0], &pairs_[0] + pairs_.size(), goes_before);
}

void OrderedPairs::finish(btBroadphasePair& ended, btDispatcher* dispatcher) {
  cleanOverlappingPair(ended, dispatcher);
  if (ghosts_ != nullptr) ghosts_->removeOverlappingPair(ended.m_pProxy0, ended.m_pProxy1, dispatcher);
}

void* OrderedPairs::end(int place, btDispatcher* dispatcher) {
  btBroadphasePair ended = pairs_[place];
  for (int i = place + 1; i < pairs_.size(); ++i) pairs_[i - 1] = pairs_[i];
  pairs_.pop_back();
  finish(ended, dispatcher);
  return ended.m_internalInfo1;
}

int OrderedPairs::place_of(const btBroadphaseProxy* a, const btBroadphaseProxy* b) const {
  for (int i = 0; i < pairs_.size(); ++i)
    if ((pairs_[i].m_pProxy0 == a && pairs_[i].m_pProxy1 == b) ||
        (pairs_[i].m_pProxy0 == b && pairs_[i].m_pProxy1 == a))
      return i;
  return pairs_.size();
}

btBroadphasePair* OrderedPairs::findPair(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  const int place = place_of(a, b);
  return place == pairs_.size() ? nullptr : &pairs_[place];
}

btBroadphasePair* OrderedPairs::addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) {
  if (!needsBroadphaseCollision(a, b)) return nullptr;
  if (btBroadphasePair* const held = findPair(a, b)) return held;
  pairs_.push_back(btBroadphasePair(*a, *b));
  btBroadphasePair& pair = pairs_[pairs_.size() - 1];
  if (ghosts_ != nullptr) ghosts_->addOverlappingPair(pair.m_pProxy0, pair.m_pProxy1);
  return &pair;
}

void* OrderedPairs::removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) {
  const int place = place_of(a, b);
  return place == pairs_.size() ? nullptr : end(place, dispatcher);
}

void OrderedPairs::removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  for (int i = pairs_.size(); i-- > 0;)
    if (pairs_[i].m_pProxy0 == proxy || pairs_[i].m_pProxy1 == proxy) end(i, dispatcher);
}

void OrderedPairs::cleanOverlappingPair(btBroadphasePair& pair, btDispatcher* dispatcher) {
  if (pair.m_algorithm == nullptr || dispatcher == nullptr) return;
  pair.m_algorithm->~btCollisionAlgorithm();
  dispatcher->freeCollisionAlgorithm(pair.m_algorithm);
  pair.m_algorithm = nullptr;
}

void OrderedPairs::cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  for (int i = pairs_.size(); i-- > 0;)
    if (pairs_[i].m_pProxy0 == proxy || pairs_[i].m_pProxy1 == proxy) cleanOverlappingPair(pairs_[i], dispatcher);
}

void OrderedPairs::processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher) {
  for (int i = 0; i < pairs_.size();) {
    if (callback->processOverlap(pairs_[i]))
      end(i, dispatcher);
    else
      ++i;
  }
}

bool OrderedPairs::needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  if (filter_ != nullptr) return filter_->needBroadphaseCollision(a, b);
  return (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 &&
         (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0;
}

}  // namespace boxstream::worlds_test
