// SPDX-License-Identifier: MIT
#pragma once

#include <btBulletCollisionCommon.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "formats/record/forwarding_broadphase.hpp"

namespace boxstream::bullet_test {

/// What a broad-phase owes the oracle: exactly its pairs, or its pairs and others whose boxes do not overlap.
enum class Rule { exact, superset };

/// True for a box that the contract makes a promise about: no NaN, min <= max. Infinite sides are fine.
bool is_valid_box(const btVector3& lo, const btVector3& hi);
/// Closed intervals on all three axes, in the scalar type of the build.
bool boxes_overlap(const btVector3& lo0, const btVector3& hi0, const btVector3& lo1, const btVector3& hi1);

/// Stands between a world and a broad-phase, forwards every call, and remembers the last box passed for each proxy.
///
/// After each calculateOverlappingPairs it works out by brute force the set E of pairs that overlap and whose filter
/// accepted them when they were first seen to overlap; `check` compares the cache with it. Pairs are named by the
/// serial numbers of their proxies (0, 1, 2 ... in the order of creation, never used again), because some native
/// broad-phases use unique ids and addresses again.
///
/// It asks the cache's filter once for each overlapping pair that is not in E yet, so do not combine it with a filter
/// that counts its calls. Proxies with an invalid box are left out of the comparison: no contract covers their pairs.
class Oracle : public boxstream::record::ForwardingBroadphase {
 public:
  using SerialPair = std::pair<std::uint32_t, std::uint32_t>;

  using ForwardingBroadphase::ForwardingBroadphase;

  /// Compares the pair cache with E; call it after calculateOverlappingPairs, before boxes change. Also fails on a null
  /// or unknown proxy, on a pair held twice and on one whose first proxy has the higher unique id.
  testing::AssertionResult check(Rule rule) const;

  /// E as of the last calculateOverlappingPairs, ascending.
  const std::vector<SerialPair>& expected() const { return expected_; }
  /// Partners of one proxy in E.
  std::vector<const btBroadphaseProxy*> expected_partners(const btBroadphaseProxy* proxy) const;

  /// Proxies that an exact aabbTest reports right now: closed overlap with their last boxes.
  std::vector<const btBroadphaseProxy*> expected_in_box(const btVector3& lo, const btVector3& hi) const;
  /// Whether the last boxes of two live proxies overlap.
  bool overlap_now(const btBroadphaseProxy* a, const btBroadphaseProxy* b) const;

  /// Called at the end of each calculateOverlappingPairs: the moment at which the contract fixes pairs and ghost lists.
  std::function<void()> after_calculate;

  std::size_t live() const { return records_.size(); }
  std::uint32_t serial(const btBroadphaseProxy* proxy) const { return records_.at(proxy).serial; }
  std::uint64_t calculations() const { return calculations_; }

  btBroadphaseProxy* createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client, int group,
                                 int mask, btDispatcher* dispatcher) override;
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  void setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) override;
  void calculateOverlappingPairs(btDispatcher* dispatcher) override;

 private:
  struct Record {
    std::uint32_t serial;
    btVector3 lo;
    btVector3 hi;
  };
  struct Live {
    btBroadphaseProxy* proxy;
    Record record;
    bool valid;
  };

  std::vector<Live> live_by_serial() const;
  void update_expected();
  std::string describe(SerialPair pair) const;

  std::unordered_map<const btBroadphaseProxy*, Record> records_;
  std::vector<SerialPair> expected_;
  std::uint32_t next_serial_ = 0;
  std::uint64_t calculations_ = 0;
};

/// The same for a world whose broad-phase is an Oracle.
testing::AssertionResult check(btCollisionWorld& world, Rule rule);

}  // namespace boxstream::bullet_test
