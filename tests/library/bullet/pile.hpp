// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/bullet.hpp>

#include <cstdint>
#include <vector>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {

/// Cubes that tremble about places of a lattice, where some nearly touch.
class Pile {
 public:
  explicit Pile(bullet::Options options = {}, int side = 5, std::uint64_t start = 3)
      : broadphase(options), random_(start) {
    for (int x = 0; x < side; ++x)
      for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z) {
          const btVector3 jitter = random_.vector(btScalar(-0.04), btScalar(0.04));
          add(btVector3(btScalar(x), btScalar(y), btScalar(z)) + jitter - btVector3(2, 2, 2));
        }
  }
  ~Pile() {
    for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  }

  void add(const btVector3& at, int group = 1, int mask = -1) {
    const Box box = cube(at.x(), at.y(), at.z());
    places.push_back(at);
    proxies.push_back(broadphase.createProxy(box.lo, box.hi, BOX_SHAPE_PROXYTYPE, nullptr, group, mask, nullptr));
  }
  void remove(std::size_t i) {
    broadphase.destroyProxy(proxies[i], nullptr);
    proxies.erase(proxies.begin() + std::ptrdiff_t(i));
    places.erase(places.begin() + std::ptrdiff_t(i));
  }
  void set(std::size_t i, const btVector3& at) {
    const Box box = cube(at.x(), at.y(), at.z());
    broadphase.setAabb(proxies[i], box.lo, box.hi, nullptr);
  }
  void tremble(btScalar by = btScalar(0.001)) {
    for (std::size_t i = 0; i < proxies.size(); ++i) set(i, places[i] + random_.vector(-by, by));
  }
  void calculate() { broadphase.calculateOverlappingPairs(nullptr); }

  /// Sorted, of those that group and mask accept.
  std::vector<UidPair> expected() const {
    std::vector<UidPair> pairs;
    for (const btBroadphaseProxy* a : proxies)
      for (const btBroadphaseProxy* b : proxies)
        if (a->m_uniqueId < b->m_uniqueId && is_valid_box(a->m_aabbMin, a->m_aabbMax) &&
            is_valid_box(b->m_aabbMin, b->m_aabbMax) &&
            boxes_overlap(a->m_aabbMin, a->m_aabbMax, b->m_aabbMin, b->m_aabbMax) &&
            (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 &&
            (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0)
          pairs.emplace_back(a->m_uniqueId, b->m_uniqueId);
    return sorted(pairs);
  }
  /// Compares pairs with all, and that they are in order.
  void check(const char* when, int frame) {
    ASSERT_EQ(pairs_of(broadphase), expected()) << when << ", frame " << frame;
    ASSERT_NO_THROW(broadphase.validate()) << when << ", frame " << frame;
  }
  /// Until boxes stay in their rooms.
  void settle() {
    for (int frame = 0; frame < 40; ++frame) {
      tremble();
      calculate();
    }
    ASSERT_EQ(broadphase.stats().moved, 0u) << "no rooms";
  }

  bullet::Broadphase broadphase;
  std::vector<btBroadphaseProxy*> proxies;
  std::vector<btVector3> places;

 private:
  Random random_;
};

}  // namespace boxstream::bullet_test
