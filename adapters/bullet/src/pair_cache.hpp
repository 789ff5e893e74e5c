// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/world.hpp>

#include "pair_store.hpp"
#include "precision.hpp"
#include "proxy.hpp"
#include "user_changes.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// The broad-phase's own pair cache: what Bullet expects of btHashedOverlappingPairCache, with one flat merge per step
/// in place of a hash table, and pairs in the order of their unique ids after each batch.
///
/// Holds proxies of its own broad-phase only. The next batch decides anew about pairs that users add or remove.
/// Callbacks run when the array is in its final state, so that they may read it. If one changes it all the same,
/// nothing is corrupted.
class PairCache final : public btOverlappingPairCache {
 public:
  /// Before an update, of which the World has been told what users changed, and after it. In between pairs are those of
  /// the World and those that users added; afterwards those of the World, in order.
  void prepare(const BasicWorld<btScalar>& world) { store_.prepare(world); }
  void follow(const BasicWorld<btScalar>& world);
  /// Tells of what began and ended.
  void deliver(btDispatcher* dispatcher);
  /// Pairs that began outside a batch. All are held when the first is announced.
  void begin_early(const std::vector<btBroadphasePair>& begun, btDispatcher* dispatcher);
  /// As removeOverlappingPairsContainingProxy, but for a proxy that is about to leave the World, which must be told of
  /// what users changed before it does.
  void remove_all_of(Proxy& proxy, btDispatcher* dispatcher);
  /// To be told to the World before each batch, and before pairs begin early.
  UserChanges& user_changes() { return user_changes_; }
  /// No proxy is left.
  void clear() { store_.clear(); }
  /// How often a filter callback was set.
  unsigned filters_set() const { return filters_set_; }
  bool has_ghost_callback() const { return ghost_callback_ != nullptr; }
  /// While callbacks run that must not change the set of pairs.
  bool is_calling_out() const { return calls_out_ != 0; }
  /// Every pair is the World's or a user's, and every pair of the World is here unless a user removed it.
  void validate(const BasicWorld<btScalar>& world) const;

  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) override;
  void* removeOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1, btDispatcher* dispatcher) override;
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

  btBroadphasePair* getOverlappingPairArrayPtr() override;
  const btBroadphasePair* getOverlappingPairArrayPtr() const override;
  btBroadphasePairArray& getOverlappingPairArray() override { return store_.array(); }
  int getNumOverlappingPairs() const override { return int(store_.size()); }
  btBroadphasePair* findPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) override;

  void cleanOverlappingPair(btBroadphasePair& pair, btDispatcher* dispatcher) override;
  void cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

  bool needsBroadphaseCollision(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) const override;
  btOverlapFilterCallback* getOverlapFilterCallback() override { return filter_callback_; }
  void setOverlapFilterCallback(btOverlapFilterCallback* callback) override {
    filter_callback_ = callback;
    ++filters_set_;
  }
  void setInternalGhostPairCallback(btOverlappingPairCallback* callback) override { ghost_callback_ = callback; }

  void processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher) override;
  /// With deterministic order: descending unique ids. The callback may remove pairs here too.
  void processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher,
                                  const btDispatcherInfo& dispatchInfo) override;

  bool hasDeferredRemoval() override { return false; }
  /// Unlike Bullet's own, keeps algorithms and makes no calls.
  void sortOverlappingPairs(btDispatcher* dispatcher) override;

 private:
  class CallingOut;

  /// Calls the callback for the pair at `index` and removes the pair if it says so.
  bool process(btOverlapCallback& callback, std::uint32_t index, btDispatcher* dispatcher);
  /// Removes the pair at `index`, which the World has not ended; then frees its algorithm and tells ghosts. Returns its
  /// m_internalInfo1.
  void* take_away(std::uint32_t index, btDispatcher* dispatcher);
  void finish(btBroadphasePair& removed, btDispatcher* dispatcher);
  void announce(const btBroadphasePair& added);
  void finish_pending_of(const Proxy& proxy, btDispatcher* dispatcher);

  PairStore store_;
  btOverlapFilterCallback* filter_callback_ = nullptr;
  btOverlappingPairCallback* ghost_callback_ = nullptr;
  unsigned filters_set_ = 0;
  UserChanges user_changes_;
  bool users_added_ = false;  ///< maybe; else all pairs are the World's
  int calls_out_ = 0;

  // Events that no callback has been told of yet: of the batch being applied, or what is left of one in which a
  // callback threw.
  std::vector<btBroadphasePair> leaving_;
  std::vector<btBroadphasePair> arriving_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
