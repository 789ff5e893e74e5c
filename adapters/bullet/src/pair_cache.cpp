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

struct Couple {
  Proxy& low;
  Proxy& high;
};

Couple in_order(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) {
  if (proxy1->m_uniqueId < proxy0->m_uniqueId) std::swap(proxy0, proxy1);
  return {static_cast<Proxy&>(*proxy0), static_cast<Proxy&>(*proxy1)};
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

void PairCache::apply_batch(std::vector<KeyedPair>& begun, const std::vector<KeyedPair>& ended,
                            btDispatcher* dispatcher) {
  deliver(dispatcher);
  or_fatal([&] {
    store_.restore_order();
    if (!user_changes_.empty()) merge_user_changes(begun);
    store_.exchange(ended, begun, leaving_);
    if (ghost_callback_) arriving_ = begun;
  });
  deliver(dispatcher);
}

void PairCache::deliver(btDispatcher* dispatcher) {
  if (leaving_.empty() && arriving_.empty()) return;
  const CallingOut calling_out(*this);
  // By index, and emptied as they go: see finish_pending_of.
  for (std::size_t i = 0; i < leaving_.size(); ++i) {
    btBroadphasePair pair = std::exchange(leaving_[i].pair, btBroadphasePair());
    if (pair.m_pProxy0) finish(pair, dispatcher);
  }
  leaving_.clear();
  for (std::size_t i = 0; i < arriving_.size(); ++i) {
    const btBroadphasePair pair = std::exchange(arriving_[i].pair, btBroadphasePair());
    if (pair.m_pProxy0) announce(pair);
  }
  arriving_.clear();
}

/// What a user added is the World's from now on if the World found it too; if not, it goes.
void PairCache::merge_user_changes(std::vector<KeyedPair>& begun) {
  unconfirmed_.clear();
  auto next = begun.begin();
  user_changes_.for_each_in_batch([&](std::uint64_t key) {
    while (next != begun.end() && next->key < key) ++next;
    if (next == begun.end() || next->key != key) unconfirmed_.push_back(key);
  });
  store_.exchange(unconfirmed_, {}, leaving_);
  std::erase_if(begun, [&](const KeyedPair& pair) { return store_.contains_sorted(pair.key); });
  user_changes_.end_batch();
}

void PairCache::begin_early(const std::vector<KeyedPair>& begun, btDispatcher* dispatcher) {
  deliver(dispatcher);
  or_fatal([&] {
    for (const KeyedPair& early : begun) {
      const Couple pair = in_order(early.pair.m_pProxy0, early.pair.m_pProxy1);
      user_changes_.by_world(early.key);
      if (store_.find(pair.low, pair.high) != PairStore::npos) continue;
      store_.add(early);
      if (ghost_callback_) arriving_.push_back(early);
    }
  });
  deliver(dispatcher);
}

void PairCache::remove_all_of(Proxy& proxy, btDispatcher* dispatcher) {
  if (!is_calling_out()) deliver(dispatcher);
  finish_pending_of(proxy, dispatcher);
  while (true) {
    const std::uint32_t index = or_fatal([&] { return store_.any_of(proxy); });
    if (index == PairStore::npos) return;
    take_away(index, dispatcher);
  }
}

void PairCache::finish_pending_of(const Proxy& proxy, btDispatcher* dispatcher) {
  for (std::size_t i = 0; i < leaving_.size(); ++i) {
    if (!names(leaving_[i].pair, proxy)) continue;
    btBroadphasePair pair = std::exchange(leaving_[i].pair, btBroadphasePair());
    finish(pair, dispatcher);
  }
  for (KeyedPair& arriving : arriving_)
    if (names(arriving.pair, proxy)) arriving.pair = btBroadphasePair();
}

btBroadphasePair* PairCache::addOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) {
  if (proxy0 == proxy1 || !needsBroadphaseCollision(proxy0, proxy1)) return nullptr;
  const Couple pair = in_order(proxy0, proxy1);
  std::uint32_t index = or_fatal([&] { return store_.find(pair.low, pair.high); });
  if (index != PairStore::npos) return &store_[index];
  const KeyedPair added(pair.low, pair.high);
  index = or_fatal([&] {
    user_changes_.by_user(pair.low, pair.high);
    return store_.add(added);
  });
  announce(added.pair);
  return &store_[index];
}

void* PairCache::removeOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1, btDispatcher* dispatcher) {
  const Couple pair = in_order(proxy0, proxy1);
  const std::uint32_t index = or_fatal([&] { return store_.find(pair.low, pair.high); });
  return index == PairStore::npos ? nullptr : take_away_for_user(index, dispatcher);
}

void PairCache::removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  while (true) {
    const std::uint32_t index = or_fatal([&] { return store_.any_of(static_cast<Proxy&>(*proxy)); });
    if (index == PairStore::npos) return;
    take_away_for_user(index, dispatcher);
  }
}

void* PairCache::take_away_for_user(std::uint32_t index, btDispatcher* dispatcher) {
  const btBroadphasePair& pair = store_[index];
  or_fatal([&] {
    user_changes_.by_user(static_cast<const Proxy&>(*pair.m_pProxy0), static_cast<const Proxy&>(*pair.m_pProxy1));
  });
  return take_away(index, dispatcher);
}

void* PairCache::take_away(std::uint32_t index, btDispatcher* dispatcher) {
  btBroadphasePair pair = store_[index];
  or_fatal([&] { store_.remove(index); });
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
  const Couple pair = in_order(proxy0, proxy1);
  const std::uint32_t index = or_fatal([&] { return store_.find(pair.low, pair.high); });
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
  const std::uint64_t key = store_.key(index);
  if (!callback.processOverlap(store_[index])) return false;
  // The callback should not have changed the pairs itself; if it did, another pair may be here now.
  if (index < store_.size() && store_.key(index) == key) take_away_for_user(index, dispatcher);
  return true;
}

void PairCache::sortOverlappingPairs(btDispatcher*) {
  or_fatal([&] { store_.restore_order(); });
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
