// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <memory>
#include <utility>

namespace boxstream::scenes {

/// For btOverlappingPairCache::processAllOverlappingPairs: ends every pair, algorithms and ghosts' lists included.
struct EndAllPairs final : btOverlapCallback {
  bool processOverlap(btBroadphasePair&) override { return true; }
};

}  // namespace boxstream::scenes

namespace boxstream::record {

/// A broad-phase that passes every call on to another one, which it owns: the base of monitors and
/// faults. The pair cache is that of the other one.
class ForwardingBroadphase : public btBroadphaseInterface {
 public:
  explicit ForwardingBroadphase(std::unique_ptr<btBroadphaseInterface> inner) : inner_(std::move(inner)) {}
  ForwardingBroadphase(const ForwardingBroadphase&) = delete;
  ForwardingBroadphase& operator=(const ForwardingBroadphase&) = delete;

  btBroadphaseInterface& inner() { return *inner_; }
  const btBroadphaseInterface& inner() const { return *inner_; }

  btBroadphaseProxy* createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client, int group,
                                 int mask, btDispatcher* dispatcher) override {
    return inner_->createProxy(lo, hi, shape_type, client, group, mask, dispatcher);
  }
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override {
    inner_->destroyProxy(proxy, dispatcher);
  }
  void setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) override {
    inner_->setAabb(proxy, lo, hi, dispatcher);
  }
  void getAabb(btBroadphaseProxy* proxy, btVector3& lo, btVector3& hi) const override {
    inner_->getAabb(proxy, lo, hi);
  }
  void rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback, const btVector3& lo,
               const btVector3& hi) override {
    inner_->rayTest(from, to, callback, lo, hi);
  }
  void aabbTest(const btVector3& lo, const btVector3& hi, btBroadphaseAabbCallback& callback) override {
    inner_->aabbTest(lo, hi, callback);
  }
  void calculateOverlappingPairs(btDispatcher* dispatcher) override { inner_->calculateOverlappingPairs(dispatcher); }
  btOverlappingPairCache* getOverlappingPairCache() override { return inner_->getOverlappingPairCache(); }
  const btOverlappingPairCache* getOverlappingPairCache() const override {
    return std::as_const(*inner_).getOverlappingPairCache();
  }
  void getBroadphaseAabb(btVector3& lo, btVector3& hi) const override { inner_->getBroadphaseAabb(lo, hi); }
  void resetPool(btDispatcher* dispatcher) override { inner_->resetPool(dispatcher); }
  void printStats() override { inner_->printStats(); }

 private:
  std::unique_ptr<btBroadphaseInterface> inner_;
};

}  // namespace boxstream::record
