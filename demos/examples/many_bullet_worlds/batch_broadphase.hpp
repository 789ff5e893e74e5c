// SPDX-License-Identifier: MIT
// Broad-phases of many Bullet worlds that are stepped together: one search a step finds the pairs of all of them.
#pragma once

#include <boxstream/boxstream.hpp>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include <btBulletDynamicsCommon.h>

/// The broad-phase of one world: its boxes, and its pairs as a BatchOfWorlds has found them. Rays and boxes are tested
/// against all proxies, for there are few.
class MemberBroadphase : public btBroadphaseInterface {
 public:
  ~MemberBroadphase() override {
    for (btBroadphaseProxy* proxy : proxies_) delete proxy;
  }

  btBroadphaseProxy* createProxy(const btVector3& min, const btVector3& max, int, void* object, int group, int mask,
                                 btDispatcher*) override {
    const auto free_place = std::find(proxies_.begin(), proxies_.end(), nullptr);
    const auto place = free_place != proxies_.end() ? free_place : proxies_.insert(free_place, nullptr);
    *place = new btBroadphaseProxy(min, max, object, group, mask);
    (*place)->m_uniqueId = int(++created_);
    return *place;
  }
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override {
    pairs_.removeOverlappingPairsContainingProxy(proxy, dispatcher);
    const auto place = std::find(proxies_.begin(), proxies_.end(), proxy);
    const auto index = std::uint32_t(place - proxies_.begin());
    const auto ends = [index](const boxstream::Pair& pair) { return pair.a == index || pair.b == index; };
    touching_.erase(std::remove_if(touching_.begin(), touching_.end(), ends), touching_.end());
    *place = nullptr;
    delete proxy;
  }
  void setAabb(btBroadphaseProxy* proxy, const btVector3& min, const btVector3& max, btDispatcher*) override {
    proxy->m_aabbMin = min;
    proxy->m_aabbMax = max;
  }
  void getAabb(btBroadphaseProxy* proxy, btVector3& min, btVector3& max) const override {
    min = proxy->m_aabbMin;
    max = proxy->m_aabbMax;
  }

  void rayTest(const btVector3& from, const btVector3&, btBroadphaseRayCallback& callback, const btVector3& min,
               const btVector3& max) override {
    for (btBroadphaseProxy* proxy : proxies_) {
      if (proxy == nullptr) continue;
      const btVector3 bounds[] = {proxy->m_aabbMin - max, proxy->m_aabbMax - min};
      btScalar entry;
      if (btRayAabb2(from, callback.m_rayDirectionInverse, callback.m_signs, bounds, entry, 0, callback.m_lambda_max))
        callback.process(proxy);
    }
  }
  void aabbTest(const btVector3& min, const btVector3& max, btBroadphaseAabbCallback& callback) override {
    for (btBroadphaseProxy* proxy : proxies_)
      if (proxy != nullptr && TestAabbAgainstAabb2(min, max, proxy->m_aabbMin, proxy->m_aabbMax))
        callback.process(proxy);
  }

  /// The pairs of the last take() stay.
  void calculateOverlappingPairs(btDispatcher*) override {}
  btOverlappingPairCache* getOverlappingPairCache() override { return &pairs_; }
  const btOverlappingPairCache* getOverlappingPairCache() const override { return &pairs_; }
  void getBroadphaseAabb(btVector3& min, btVector3& max) const override {
    min.setValue(-BT_LARGE_FLOAT, -BT_LARGE_FLOAT, -BT_LARGE_FLOAT);
    max.setValue(BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
  }
  void printStats() override {}

  /// Null where one was destroyed; the next that is created takes the first such place.
  const std::vector<btBroadphaseProxy*>& proxies() const { return proxies_; }

  /// Makes `found` the pairs of this world; their indices, less `first`, are places of proxies(). What was not there
  /// the last time begins, as far as Bullet's filters let it, and what is no longer there ends.
  void take(boxstream::Span<boxstream::Pair> found, std::uint64_t first, btDispatcher* dispatcher) {
    for (auto& [a, b] : found) {
      a -= std::uint32_t(first);
      b -= std::uint32_t(first);
    }
    std::sort(found.begin(), found.end());
    const auto differences = [this](const auto& more, const auto& less) {
      changed_.clear();
      std::set_difference(more.begin(), more.end(), less.begin(), less.end(), std::back_inserter(changed_));
    };
    differences(touching_, found);
    for (const auto [a, b] : changed_) pairs_.removeOverlappingPair(proxies_[a], proxies_[b], dispatcher);
    differences(found, touching_);
    for (const auto [a, b] : changed_) pairs_.addOverlappingPair(proxies_[a], proxies_[b]);
    touching_.assign(found.begin(), found.end());
  }

 private:
  std::vector<btBroadphaseProxy*> proxies_;
  btHashedOverlappingPairCache pairs_;
  std::vector<boxstream::Pair> touching_, changed_;
  unsigned created_ = 0;
};

/// A world whose step is cut where the pairs are found: begin_step, updateAabbs, the search, end_step are what
/// stepSimulation(dt, 0) does.
class HalfSteppedWorld : public btDiscreteDynamicsWorld {
 public:
  using btDiscreteDynamicsWorld::btDiscreteDynamicsWorld;

  void begin_step(btScalar dt) {
    saveKinematicState(dt);
    applyGravity();
    predictUnconstraintMotion(dt);
    getDispatchInfo().m_timeStep = dt;
    getDispatchInfo().m_stepCount = 0;
    createPredictiveContacts(dt);
  }
  void end_step(btScalar dt) {
    getDispatcher()->dispatchAllCollisionPairs(getPairCache(), getDispatchInfo(), getDispatcher());
    calculateSimulationIslands();
    getSolverInfo().m_timeStep = dt;
    solveConstraints(getSolverInfo());
    integrateTransforms(dt);
    updateActions(dt);
    updateActivationState(dt);
    synchronizeMotionStates();
    clearForces();
  }
};

/// Finds the pairs of all worlds in one search.
class BatchOfWorlds {
 public:
  /// Borrowed, and with dispatchers that outlive the batch.
  void add(MemberBroadphase& member, btDispatcher& dispatcher) { members_.push_back({&member, &dispatcher}); }

  /// After the boxes were set. Returns how many pairs touch in all worlds together.
  std::size_t find_pairs() {
    boxes_.clear();
    offsets_.assign(1, 0);
    for (const Member& member : members_) {
      for (const btBroadphaseProxy* proxy : member.broadphase->proxies()) {
        if (proxy == nullptr) {
          boxes_.push_back({{1, 1, 1}, {0, 0, 0}});  // touches nothing
          continue;
        }
        const btVector3 &min = proxy->m_aabbMin, &max = proxy->m_aabbMax;
        boxes_.push_back({{min.x(), min.y(), min.z()}, {max.x(), max.y(), max.z()}});
      }
      offsets_.push_back(boxes_.size());
    }
    detector_.find_pairs(boxes_, offsets_, found_);
    for (std::size_t i = 0; i < members_.size(); ++i)
      members_[i].broadphase->take({found_.pairs.data() + found_.offsets[i], found_.offsets[i + 1] - found_.offsets[i]},
                                   offsets_[i], members_[i].dispatcher);
    return found_.pairs.size();
  }

 private:
  struct Member {
    MemberBroadphase* broadphase;
    btDispatcher* dispatcher;
  };

  std::vector<Member> members_;
  boxstream::Detector detector_;
  std::vector<boxstream::BasicAabb<btScalar>> boxes_;
  std::vector<std::uint64_t> offsets_;
  boxstream::PairsOfSets found_;
};
