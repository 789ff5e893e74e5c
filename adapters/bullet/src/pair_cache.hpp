// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/world.hpp>

#include "pair_store.hpp"
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
  /// Called before an update, after the World has got the changes of users, and after the update. In between, pairs are
  /// those of the World and those that users added; afterwards those of the World, in order.
  void prepare(const BasicWorld<btScalar>& world) {
    if (!store_.is_settled()) store_.prepare(world);
  }
  void follow(const BasicWorld<btScalar>& world);
  /// Frees algorithms of ended pairs and notifies the ghost callback of pairs that began and ended.
  void flush_notifications(btDispatcher* dispatcher) {
    constexpr std::size_t little = 1024;
    if (!pending_removed_.empty() || !pending_added_.empty() || pending_removed_.capacity() > little ||
        pending_added_.capacity() > little)
      send_notifications(dispatcher);
  }
  /// Adds pairs that began outside a batch. All are held at the first notification.
  void begin_early(const std::vector<btBroadphasePair>& begun, btDispatcher* dispatcher);
  /// As removeOverlappingPairsContainingProxy, for a proxy that is about to be destroyed. The World must get the
  /// changes of users before that.
  void remove_all_of(Proxy& proxy, btDispatcher* dispatcher);

  // Where the World is told of pairs later, while they are settled.

  /// The pairs of a proxy, which then has none until callbacks change pairs. False if there are none.
  bool end_all_of(const Proxy& proxy, btDispatcher* dispatcher);
  /// Those for which `has_ended(pair)` is true. Notifications are due then. May throw, as the next.
  template <class HasEnded>
  void end(HasEnded&& has_ended) {
    store_.take_out(has_ended, pending_removed_);
  }
  void begin(std::vector<btBroadphasePair>& begun) {
    store_.put_in(begun);
    if (ghost_callback_ != nullptr) pending_added_.insert(pending_added_.end(), begun.begin(), begun.end());
  }
  /// The World is about to be told of all pairs, and has got the changes of users.
  void settle() {
    store_.settle();
    users_added_ = false;
  }

  /// To be flushed to the World before each batch, and before pairs begin early.
  UserChanges& user_changes() { return user_changes_; }
  /// True if the pairs are those of the World, in its order, and no notification is due.
  bool is_settled() const { return pending_removed_.empty() && pending_added_.empty() && holds_worlds_pairs(); }
  /// Gives back what pairs do not need.
  void shrink_to_fit() {
    store_.shrink_to_fit();
    for (auto* notices : {&pending_removed_, &pending_added_}) notices->shrink_to_fit();
  }
  /// No proxy is left. Gives all memory back.
  void clear();
  /// The same but for notifications.
  bool holds_worlds_pairs() const { return user_changes_.empty() && store_.is_settled(); }
  PairStore& store() { return store_; }
  /// How often a filter callback was set.
  unsigned filters_set() const { return filters_set_; }
  bool has_ghost_callback() const { return ghost_callback_ != nullptr; }
  /// True while callbacks run that must not change the set of pairs.
  bool is_in_callback() const { return callback_depth_ != 0; }
  /// Every pair is the World's or a user's, and every pair of the World is here unless a user removed it.
  void validate(const BasicWorld<btScalar>& world);

  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1) override;
  void* removeOverlappingPair(btBroadphaseProxy* proxy0, btBroadphaseProxy* proxy1, btDispatcher* dispatcher) override;
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;

  btBroadphasePair* getOverlappingPairArrayPtr() override;
  const btBroadphasePair* getOverlappingPairArrayPtr() const override;
  btBroadphasePairArray& getOverlappingPairArray() override { return store_.lend(); }
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
  class CallbackScope;

  /// Calls the callback for the pair at `index` and removes the pair if it returns true.
  bool process(btOverlapCallback& callback, std::uint32_t index, btDispatcher* dispatcher);
  /// Removes the pair at `index`, which the World has not ended; then frees its algorithm and notifies the ghost
  /// callback. Returns its m_internalInfo1.
  void* remove_pair(std::uint32_t index, btDispatcher* dispatcher);
  void finish_removed(btBroadphasePair& removed, btDispatcher* dispatcher);
  void notify_added(const btBroadphasePair& added);
  void drop_pending_of(const Proxy& proxy, btDispatcher* dispatcher);
  void send_notifications(btDispatcher* dispatcher);

  PairStore store_;
  btOverlapFilterCallback* filter_callback_ = nullptr;
  btOverlappingPairCallback* ghost_callback_ = nullptr;
  unsigned filters_set_ = 0;
  UserChanges user_changes_;
  bool users_added_ = false;  ///< perhaps; if false, all pairs are the World's
  int callback_depth_ = 0;

  // Pending notifications: of the batch being applied, or left over after a callback threw.
  std::vector<btBroadphasePair> pending_removed_;
  std::vector<btBroadphasePair> pending_added_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
