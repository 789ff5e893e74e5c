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

class PairCache::CallbackScope {
 public:
  explicit CallbackScope(PairCache& cache) : cache_(cache) { ++cache_.callback_depth_; }
  CallbackScope(const CallbackScope&) = delete;
  CallbackScope& operator=(const CallbackScope&) = delete;
  ~CallbackScope() { --cache_.callback_depth_; }

 private:
  PairCache& cache_;
};

/// A pair that a user added stays if the World found it too; if not, it is removed.
void PairCache::follow(const BasicWorld<btScalar>& world) {
  store_.follow(world, pending_removed_, pending_added_,
                [this](const btBroadphasePair& pair) { user_changes_.add(pair); });
  users_added_ = store_.in_order() != store_.size();
  if (!ghost_callback_) pending_added_.clear();
  store_.give_back_unused();
}

void PairCache::clear() {
  store_.clear();
  user_changes_ = UserChanges();
  std::vector<btBroadphasePair>().swap(pending_removed_);
  std::vector<btBroadphasePair>().swap(pending_added_);
}

/// Or, where there are none, gives the memory of many back.
void PairCache::send_notifications(btDispatcher* dispatcher) {
  if (pending_removed_.empty() && pending_added_.empty()) {
    for (auto* pending : {&pending_removed_, &pending_added_}) std::vector<btBroadphasePair>().swap(*pending);
    return;
  }
  const CallbackScope scope(*this);
  // By index, and cleared one by one: see drop_pending_of.
  for (std::size_t i = 0; i < pending_removed_.size(); ++i) {
    btBroadphasePair pair = std::exchange(pending_removed_[i], btBroadphasePair());
    if (pair.m_pProxy0) finish_removed(pair, dispatcher);
  }
  pending_removed_.clear();
  for (std::size_t i = 0; i < pending_added_.size(); ++i) {
    const btBroadphasePair pair = std::exchange(pending_added_[i], btBroadphasePair());
    if (pair.m_pProxy0) notify_added(pair);
  }
  pending_added_.clear();
}

void PairCache::begin_early(const std::vector<btBroadphasePair>& begun, btDispatcher* dispatcher) {
  or_fatal([&] {
    for (const btBroadphasePair& pair : begun) {
      if (has_destroyed(pair)) {
        user_changes_.add(pair);
        continue;
      }
      if (users_added_ && findPair(pair.m_pProxy0, pair.m_pProxy1)) continue;
      store_.add(pair);
      if (ghost_callback_) pending_added_.push_back(pair);
    }
  });
  flush_notifications(dispatcher);
}

void PairCache::remove_all_of(Proxy& proxy, btDispatcher* dispatcher) {
  if (!is_in_callback()) flush_notifications(dispatcher);
  drop_pending_of(proxy, dispatcher);
  removeOverlappingPairsContainingProxy(&proxy, dispatcher);
}

bool PairCache::end_all_of(const Proxy& proxy, btDispatcher* dispatcher) {
  or_fatal(
      [&] { store_.take_out([&](const btBroadphasePair& pair) { return names(pair, proxy); }, pending_removed_); });
  if (pending_removed_.empty()) return false;
  std::reverse(pending_removed_.begin(), pending_removed_.end());  // as removeOverlappingPairsContainingProxy
  send_notifications(dispatcher);
  return true;
}

void PairCache::drop_pending_of(const Proxy& proxy, btDispatcher* dispatcher) {
  for (std::size_t i = 0; i < pending_removed_.size(); ++i) {
    if (!names(pending_removed_[i], proxy)) continue;
    btBroadphasePair pair = std::exchange(pending_removed_[i], btBroadphasePair());
    finish_removed(pair, dispatcher);
  }
  for (btBroadphasePair& pending : pending_added_)
    if (names(pending, proxy)) pending = btBroadphasePair();
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
  notify_added(added);
  return &store_[index];
}

void* PairCache::removeOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1, btDispatcher* dispatcher) {
  const std::uint32_t index = or_fatal([&] { return store_.find(as_proxy(proxy0), as_proxy(proxy1)); });
  return index == PairStore::npos ? nullptr : remove_pair(index, dispatcher);
}

void PairCache::removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  while (true) {
    const std::uint32_t index = or_fatal([&] { return store_.any_of(as_proxy(proxy)); });
    if (index == PairStore::npos) return;
    remove_pair(index, dispatcher);
  }
}

void* PairCache::remove_pair(std::uint32_t index, btDispatcher* dispatcher) {
  btBroadphasePair pair = store_[index];
  or_fatal([&] {
    user_changes_.add(pair);
    store_.remove(index);
  });
  finish_removed(pair, dispatcher);
  return pair.m_internalInfo1;
}

void PairCache::finish_removed(btBroadphasePair& removed, btDispatcher* dispatcher) {
  cleanOverlappingPair(removed, dispatcher);
  if (ghost_callback_) ghost_callback_->removeOverlappingPair(removed.m_pProxy0, removed.m_pProxy1, dispatcher);
}

void PairCache::notify_added(const btBroadphasePair& added) {
  if (ghost_callback_) ghost_callback_->addOverlappingPair(added.m_pProxy0, added.m_pProxy1);
}

btBroadphasePair* PairCache::getOverlappingPairArrayPtr() {
  return store_.all();
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

/// Inline, because a step of a world that sleeps is hardly more than these calls.
inline bool PairCache::process(btOverlapCallback& callback, std::uint32_t index, btDispatcher* dispatcher) {
  btBroadphasePair& pair = store_[index];
  const btBroadphaseProxy *const proxy0 = pair.m_pProxy0, *const proxy1 = pair.m_pProxy1;
  if (!callback.processOverlap(pair)) return false;
  // The callback should not have changed the pairs itself; if it did, another pair may be here now.
  if (index < store_.size() && store_[index].m_pProxy0 == proxy0 && store_[index].m_pProxy1 == proxy1)
    remove_pair(index, dispatcher);
  return true;
}

void PairCache::processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher) {
  const CallbackScope scope(*this);
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
  const CallbackScope scope(*this);
  // A removal moves the last pair, which has been visited, to the free place.
  for (std::uint32_t index = store_.size(); index-- > 0;)
    if (index < store_.size()) process(*callback, index, dispatcher);
}

void PairCache::sortOverlappingPairs(btDispatcher*) {
  or_fatal([&] { store_.restore_order(); });
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
