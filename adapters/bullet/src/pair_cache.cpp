// SPDX-License-Identifier: MIT
#include "pair_cache.hpp"

#include <algorithm>
#include <utility>

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>

#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

const Proxy& as_proxy(const btBroadphaseProxy* proxy) {
  return static_cast<const Proxy&>(*proxy);
}

bool names(const btBroadphasePair& pair, const Proxy& proxy) {
  return pair.m_pProxy0 == &proxy || pair.m_pProxy1 == &proxy;
}

}  // namespace

class PairCache::CallingOut {
 public:
  explicit CallingOut(PairCache& cache) : cache_(cache) { ++cache_.calls_out_; }
  CallingOut(const CallingOut&) = delete;
  CallingOut& operator=(const CallingOut&) = delete;
  ~CallingOut() { --cache_.calls_out_; }

 private:
  PairCache& cache_;
};

/// What a user added is the World's from now on if the World found it too; if not, it goes.
void PairCache::follow(const BasicWorld<btScalar>& world) {
  store_.follow(world, leaving_, arriving_, [this](const btBroadphasePair& pair) { user_changes_.add(pair); });
  users_added_ = store_.in_order() != store_.size();
  if (!ghost_callback_) arriving_.clear();
}

void PairCache::deliver(btDispatcher* dispatcher) {
  if (leaving_.empty() && arriving_.empty()) return;
  const CallingOut calling_out(*this);
  // By index, and emptied as they go: see finish_pending_of.
  for (std::size_t i = 0; i < leaving_.size(); ++i) {
    btBroadphasePair pair = std::exchange(leaving_[i], btBroadphasePair());
    if (pair.m_pProxy0) finish(pair, dispatcher);
  }
  leaving_.clear();
  for (std::size_t i = 0; i < arriving_.size(); ++i) {
    const btBroadphasePair pair = std::exchange(arriving_[i], btBroadphasePair());
    if (pair.m_pProxy0) announce(pair);
  }
  arriving_.clear();
}

void PairCache::begin_early(const std::vector<btBroadphasePair>& begun, btDispatcher* dispatcher) {
  deliver(dispatcher);
  or_fatal([&] {
    for (const btBroadphasePair& pair : begun) {
      if (names_dying(pair)) {
        user_changes_.add(pair);
        continue;
      }
      if (users_added_ && findPair(pair.m_pProxy0, pair.m_pProxy1)) continue;
      store_.add(pair);
      if (ghost_callback_) arriving_.push_back(pair);
    }
  });
  deliver(dispatcher);
}

void PairCache::remove_all_of(Proxy& proxy, btDispatcher* dispatcher) {
  if (!is_calling_out()) deliver(dispatcher);
  finish_pending_of(proxy, dispatcher);
  removeOverlappingPairsContainingProxy(&proxy, dispatcher);
}

void PairCache::finish_pending_of(const Proxy& proxy, btDispatcher* dispatcher) {
  for (std::size_t i = 0; i < leaving_.size(); ++i) {
    if (!names(leaving_[i], proxy)) continue;
    btBroadphasePair pair = std::exchange(leaving_[i], btBroadphasePair());
    finish(pair, dispatcher);
  }
  for (btBroadphasePair& arriving : arriving_)
    if (names(arriving, proxy)) arriving = btBroadphasePair();
}

btBroadphasePair* PairCache::addOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) {
  if (proxy0 == proxy1 || !needsBroadphaseCollision(proxy0, proxy1)) return nullptr;
  if (btBroadphasePair* const held = findPair(proxy0, proxy1)) return held;
  const btBroadphasePair added(*proxy0, *proxy1);
  const std::uint32_t index = or_fatal([&] {
    user_changes_.add(added);
    users_added_ = true;
    return store_.add(added);
  });
  announce(added);
  return &store_[index];
}

void* PairCache::removeOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1, btDispatcher* dispatcher) {
  const std::uint32_t index = or_fatal([&] { return store_.find(as_proxy(proxy0), as_proxy(proxy1)); });
  return index == PairStore::npos ? nullptr : take_away(index, dispatcher);
}

void PairCache::removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  while (true) {
    const std::uint32_t index = or_fatal([&] { return store_.any_of(as_proxy(proxy)); });
    if (index == PairStore::npos) return;
    take_away(index, dispatcher);
  }
}

void* PairCache::take_away(std::uint32_t index, btDispatcher* dispatcher) {
  btBroadphasePair pair = store_[index];
  or_fatal([&] {
    user_changes_.add(pair);
    store_.remove(index);
  });
  finish(pair, dispatcher);
  return pair.m_internalInfo1;
}

void PairCache::finish(btBroadphasePair& removed, btDispatcher* dispatcher) {
  cleanOverlappingPair(removed, dispatcher);
  if (ghost_callback_) ghost_callback_->removeOverlappingPair(removed.m_pProxy0, removed.m_pProxy1, dispatcher);
}

void PairCache::announce(const btBroadphasePair& added) {
  if (ghost_callback_) ghost_callback_->addOverlappingPair(added.m_pProxy0, added.m_pProxy1);
}

btBroadphasePair* PairCache::getOverlappingPairArrayPtr() {
  return store_.size() == 0 ? nullptr : &store_[0];
}

const btBroadphasePair* PairCache::getOverlappingPairArrayPtr() const {
  return const_cast<PairCache*>(this)->getOverlappingPairArrayPtr();
}

btBroadphasePair* PairCache::findPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) {
  const std::uint32_t index = or_fatal([&] { return store_.find(as_proxy(proxy0), as_proxy(proxy1)); });
  return index == PairStore::npos ? nullptr : &store_[index];
}

void PairCache::cleanOverlappingPair(btBroadphasePair& pair, btDispatcher* dispatcher) {
  // Only the dispatcher knows how to free it; without one it leaks, as with Bullet's own caches.
  if (!pair.m_algorithm || !dispatcher) return;
  btCollisionAlgorithm* const algorithm = std::exchange(pair.m_algorithm, nullptr);
  algorithm->~btCollisionAlgorithm();
  dispatcher->freeCollisionAlgorithm(algorithm);
}

void PairCache::cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  or_fatal([&] {
    store_.for_each_of(static_cast<Proxy&>(*proxy),
                       [&](std::uint32_t index) { cleanOverlappingPair(store_[index], dispatcher); });
  });
}

bool PairCache::needsBroadphaseCollision(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) const {
  if (filter_callback_) return filter_callback_->needBroadphaseCollision(proxy0, proxy1);
  return (proxy0->m_collisionFilterGroup & proxy1->m_collisionFilterMask) != 0 &&
         (proxy1->m_collisionFilterGroup & proxy0->m_collisionFilterMask) != 0;
}

void PairCache::processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher) {
  const CallingOut calling_out(*this);
  for (std::uint32_t index = 0; index < store_.size();)
    if (!process(*callback, index, dispatcher)) ++index;
}

void PairCache::processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher,
                                           const btDispatcherInfo& dispatchInfo) {
  if (!dispatchInfo.m_deterministicOverlappingPairs) {
    processAllOverlappingPairs(callback, dispatcher);
    return;
  }
  or_fatal([&] { store_.restore_order(); });
  const CallingOut calling_out(*this);
  // A removal moves the last pair, which has been visited, to the free place.
  for (std::uint32_t index = store_.size(); index-- > 0;)
    if (index < store_.size()) process(*callback, index, dispatcher);
}

bool PairCache::process(btOverlapCallback& callback, std::uint32_t index, btDispatcher* dispatcher) {
  const btBroadphasePair pair = store_[index];
  if (!callback.processOverlap(store_[index])) return false;
  // The callback should not have changed the pairs itself; if it did, another pair may be here now.
  if (index < store_.size() && store_[index] == pair) take_away(index, dispatcher);
  return true;
}

void PairCache::sortOverlappingPairs(btDispatcher*) {
  or_fatal([&] { store_.restore_order(); });
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
