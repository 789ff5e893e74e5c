// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <vector>

namespace boxstream::worlds_test {

/// A pair cache that is plain to see through: an array, searched from end to end.
///
/// What it does, and in which order, is a function of the pairs alone. In a batch pairs end before others begin, both
/// in the order of their unique ids; afterwards the array is in that order. Pairs that are added between batches stand
/// behind the others; those of a proxy that goes are ended from the back.
class OrderedPairs final : public btOverlappingPairCache {
 public:
  /// Holds what overlaps now, each in order of ids and all sorted: goes on with what it held, ends the rest, and begins
  /// what the filter accepts.
  void batch(const std::vector<btBroadphasePair>& overlapping, btDispatcher* dispatcher);
  bool has_ghost_callback() const { return ghosts_ != nullptr; }

  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override;
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  btBroadphasePair* findPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override;

  btBroadphasePair* getOverlappingPairArrayPtr() override { return pairs_.size() == 0 ? nullptr : &pairs_[0]; }
  const btBroadphasePair* getOverlappingPairArrayPtr() const override {
    return pairs_.size() == 0 ? nullptr : &pairs_[0];
  }
  btBroadphasePairArray& getOverlappingPairArray() override { return pairs_; }
  int getNumOverlappingPairs() const override { return pairs_.size(); }

  void cleanOverlappingPair(btBroadphasePair& pair, btDispatcher* dispatcher) override;
  void cleanProxyFromPairs(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  void processAllOverlappingPairs(btOverlapCallback* callback, btDispatcher* dispatcher) override;
  using btOverlappingPairCache::processAllOverlappingPairs;

  bool needsBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override;
  btOverlapFilterCallback* getOverlapFilterCallback() override { return filter_; }
  void setOverlapFilterCallback(btOverlapFilterCallback* callback) override { filter_ = callback; }
  void setInternalGhostPairCallback(btOverlappingPairCallback* callback) override { ghosts_ = callback; }
  bool hasDeferredRemoval() override { return false; }
  void sortOverlappingPairs(btDispatcher*) override { sort(); }

 private:
  void sort();
  /// Takes the pair at `place` out of the array, and leaves the others in order.
  void* end(int place, btDispatcher* dispatcher);
  void finish(btBroadphasePair& ended, btDispatcher* dispatcher);
  int place_of(const btBroadphaseProxy* a, const btBroadphaseProxy* b) const;

  btBroadphasePairArray pairs_;
  btOverlapFilterCallback* filter_ = nullptr;
  btOverlappingPairCallback* ghosts_ = nullptr;
};

/// By the unique ids of the first proxies, then of the second ones.
bool goes_before(const btBroadphasePair& a, const btBroadphasePair& b);

}  // namespace boxstream::worlds_test
