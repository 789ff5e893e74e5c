// SPDX-License-Identifier: MIT
#include "brute_force.hpp"

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <algorithm>
#include <cstring>
#include <tuple>

namespace boxstream::worlds_test {
namespace {

bool boxes_overlap(const btVector3& lo0, const btVector3& hi0, const btVector3& lo1, const btVector3& hi1) {
  for (int d = 0; d < 3; ++d)
    if (!(lo0[d] <= hi1[d] && lo1[d] <= hi0[d])) return false;
  return true;
}

bool boxes_overlap(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  return boxes_overlap(a.m_aabbMin, a.m_aabbMax, b.m_aabbMin, b.m_aabbMax);
}

/// Slab by slab. Bullet gives 1e18 for the inverse of 0, so that nothing here becomes NaN.
bool ray_meets(const btVector3& from, const btBroadphaseRayCallback& ray, const btVector3& lo, const btVector3& hi) {
  btScalar begin = 0, end = ray.m_lambda_max;
  for (int d = 0; d < 3; ++d) {
    const btScalar a = (lo[d] - from[d]) * ray.m_rayDirectionInverse[d];
    const btScalar b = (hi[d] - from[d]) * ray.m_rayDirectionInverse[d];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end;
}

/// The fourth component of Bullet's vectors is padding.
bool has_same_bits(const btVector3& a, const btVector3& b) {
  return std::memcmp(a.m_floats, b.m_floats, 3 * sizeof(btScalar)) == 0;
}

bool is_box(const btBroadphaseProxy& proxy) {
  for (int d = 0; d < 3; ++d)
    if (!(proxy.m_aabbMin[d] <= proxy.m_aabbMax[d])) return false;
  return true;
}

bool is_ghost(const btBroadphaseProxy& proxy) {
  return static_cast<const btCollisionObject*>(proxy.m_clientObject)->getInternalType() ==
         btCollisionObject::CO_GHOST_OBJECT;
}

}  // namespace

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

BruteForce::~BruteForce() = default;

btBroadphaseProxy* BruteForce::createProxy(const btVector3& lo, const btVector3& hi, int, void* client, int group,
                                           int mask, btDispatcher*) {
  live_.push_back(std::make_unique<btBroadphaseProxy>(lo, hi, client, group, mask));
  live_.back()->m_uniqueId = ++last_id_;
  begin_pairs_of_ghost(*live_.back());
  return live_.back().get();
}

void BruteForce::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  pairs_.removeOverlappingPairsContainingProxy(proxy, dispatcher);
  live_.erase(std::find_if(live_.begin(), live_.end(), [&](const auto& own) { return own.get() == proxy; }));
}

void BruteForce::setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher*) {
  if (has_same_bits(proxy->m_aabbMin, lo) && has_same_bits(proxy->m_aabbMax, hi)) return;
  proxy->m_aabbMin = lo;
  proxy->m_aabbMax = hi;
  begin_pairs_of_ghost(*proxy);
}

void BruteForce::getAabb(btBroadphaseProxy* proxy, btVector3& lo, btVector3& hi) const {
  lo = proxy->m_aabbMin;
  hi = proxy->m_aabbMax;
}

// What characters rely on: see Eager::ghosts of boxstream's options.
void BruteForce::begin_pairs_of_ghost(btBroadphaseProxy& proxy) {
  if (!pairs_.has_ghost_callback() || !is_ghost(proxy) || !is_box(proxy)) return;
  for (const auto& other : live_)
    if (other.get() != &proxy && is_box(*other) && boxes_overlap(proxy, *other))
      pairs_.addOverlappingPair(&proxy, other.get());
}

void BruteForce::calculateOverlappingPairs(btDispatcher* dispatcher) {
  std::vector<btBroadphaseProxy*> order;
  for (const auto& proxy : live_)
    if (is_box(*proxy)) order.push_back(proxy.get());
  std::sort(order.begin(), order.end(),
            [](const btBroadphaseProxy* a, const btBroadphaseProxy* b) { return a->m_aabbMin.x() < b->m_aabbMin.x(); });
  std::vector<btBroadphasePair> overlapping;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size() && order[k]->m_aabbMin.x() <= order[i]->m_aabbMax.x(); ++k)
      if (boxes_overlap(*order[i], *order[k])) overlapping.emplace_back(*order[i], *order[k]);
  std::sort(overlapping.begin(), overlapping.end(), goes_before);
  pairs_.batch(overlapping, dispatcher);
}

void BruteForce::aabbTest(const btVector3& lo, const btVector3& hi, btBroadphaseAabbCallback& callback) {
  for (const auto& proxy : live_)
    if (is_box(*proxy) && boxes_overlap(proxy->m_aabbMin, proxy->m_aabbMax, lo, hi)) callback.process(proxy.get());
}

void BruteForce::rayTest(const btVector3& from, const btVector3&, btBroadphaseRayCallback& callback,
                         const btVector3& lo, const btVector3& hi) {
  for (const auto& proxy : live_)
    if (is_box(*proxy) && ray_meets(from, callback, proxy->m_aabbMin - hi, proxy->m_aabbMax - lo))
      callback.process(proxy.get());
}

void BruteForce::getBroadphaseAabb(btVector3& lo, btVector3& hi) const {
  lo.setValue(-BT_LARGE_FLOAT, -BT_LARGE_FLOAT, -BT_LARGE_FLOAT);
  hi.setValue(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
}

}  // namespace boxstream::worlds_test
