// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <memory>
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

/// The simplest broad-phase that is right: exact closed boxes, compared along a list sorted by one side, in quadratic
/// time when many share that side. It keeps what boxstream's promises of its pairs: they are those of the last
/// calculateOverlappingPairs, in the order of unique ids 1, 2, 3 ... of creation, and those of ghosts begin at once.
///
/// It shares no code with what it is compared to. Queries are exact too, because sweeps see bodies that have moved away
/// from their boxes: what is reported decides what is hit. They report in the order of ids.
class BruteForce final : public btBroadphaseInterface {
 public:
  BruteForce() = default;
  ~BruteForce() override;
  BruteForce(const BruteForce&) = delete;
  BruteForce& operator=(const BruteForce&) = delete;

  btBroadphaseProxy* createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client, int group,
                                 int mask, btDispatcher* dispatcher) override;
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  void setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) override;
  void getAabb(btBroadphaseProxy* proxy, btVector3& lo, btVector3& hi) const override;
  void rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback, const btVector3& lo,
               const btVector3& hi) override;
  void aabbTest(const btVector3& lo, const btVector3& hi, btBroadphaseAabbCallback& callback) override;
  void calculateOverlappingPairs(btDispatcher* dispatcher) override;
  btOverlappingPairCache* getOverlappingPairCache() override { return &pairs_; }
  const btOverlappingPairCache* getOverlappingPairCache() const override { return &pairs_; }
  void getBroadphaseAabb(btVector3& lo, btVector3& hi) const override;
  void printStats() override {}

 private:
  void begin_pairs_of_ghost(btBroadphaseProxy& proxy);

  OrderedPairs pairs_;
  std::vector<std::unique_ptr<btBroadphaseProxy>> live_;  ///< in the order of their unique ids
  int last_id_ = 0;
};

}  // namespace boxstream::worlds_test
