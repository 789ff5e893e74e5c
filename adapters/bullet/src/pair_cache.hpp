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
  /// Takes over the result of a batch, both in key order. `begun` may name pairs that are held, `ended` pairs that are
  /// not. Afterwards the pairs are those of the World, in order.
  void apply_batch(std::vector<KeyedPair>& begun, const std::vector<KeyedPair>& ended, btDispatcher* dispatcher);
  /// Pairs that began outside a batch. All are held when the first is announced.
  void begin_early(const std::vector<KeyedPair>& begun, btDispatcher* dispatcher);
  /// As removeOverlappingPairsContainingProxy, but for a proxy that leaves the World: nothing will come back.
  void remove_all_of(Proxy& proxy, btDispatcher* dispatcher);
  /// To be told to the World before each batch, and before pairs begin early.
  UserChanges& user_changes() { return user_changes_; }
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
  /// Unlike Bullet's own, keeps algorithms and calls nobody.
  void sortOverlappingPairs(btDispatcher* dispatcher) override;

 private:
  class CallingOut;

  /// Calls the callback for the pair at `index` and removes the pair if it says so.
  bool process(btOverlapCallback& callback, std::uint32_t index, btDispatcher* dispatcher);
  /// Removes the pair at `index`, then frees its algorithm and tells ghosts; returns its m_internalInfo1.
  void* take_away(std::uint32_t index, btDispatcher* dispatcher);
  void* take_away_for_user(std::uint32_t index, btDispatcher* dispatcher);
  void finish(btBroadphasePair& removed, btDispatcher* dispatcher);
  void announce(const btBroadphasePair& added);
  void deliver(btDispatcher* dispatcher);
  void merge_user_changes(std::vector<KeyedPair>& begun);
  void finish_pending_of(const Proxy& proxy, btDispatcher* dispatcher);

  PairStore store_;
  btOverlapFilterCallback* filter_callback_ = nullptr;
  btOverlappingPairCallback* ghost_callback_ = nullptr;
  unsigned filters_set_ = 0;
  UserChanges user_changes_;
  std::vector<std::uint64_t> unconfirmed_;  ///< scratch of merge_user_changes: keys
  int calls_out_ = 0;

  // Events that nobody has been told of yet: of the batch being applied, or what is left of one in which a callback
  // threw.
  std::vector<KeyedPair> leaving_;
  std::vector<KeyedPair> arriving_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
