// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>

#include <memory>
#include <vector>

#include "ordered_pairs.hpp"

namespace boxstream::worlds_test {

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
