// SPDX-License-Identifier: MIT
// boxstream::coal::CollisionManager: the contract of managers, and what Coal has of its own.
#include <utility>
#include <vector>

#include <coal/broadphase/broadphase_bruteforce.h>
#include <coal/shape/geometric_shapes.h>
#include <boxstream/coal.hpp>

#include "managers/contract.hpp"

namespace boxstream::managers_test {
namespace {

using ::coal::CoalScalar;
using ::coal::CollisionObject;

template <class OnPair>
struct Collide : ::coal::CollisionCallBackBase {
  explicit Collide(OnPair& use) : on_pair(use) {}
  void init() override { ++inits; }
  bool collide(CollisionObject* a, CollisionObject* b) override {
    EXPECT_EQ(inits, 1) << "init() comes first";
    return on_pair(a, b);
  }
  OnPair& on_pair;
  int inits = 0;
};

template <class OnPair>
struct Distance : ::coal::DistanceCallBackBase {
  explicit Distance(OnPair& use) : on_pair(use) {}
  void init() override { ++inits; }
  bool distance(CollisionObject* a, CollisionObject* b, CoalScalar& least) override {
    EXPECT_EQ(inits, 1) << "init() comes first";
    return on_pair(a, b, least);
  }
  OnPair& on_pair;
  int inits = 0;
};

struct Coal {
  using Scalar = CoalScalar;
  using Object = CollisionObject;
  using Base = ::coal::BroadPhaseCollisionManager;
  using Manager = boxstream::coal::CollisionManager;
  using Foreign = ::coal::NaiveCollisionManager;

  static std::unique_ptr<Object> object() { return std::make_unique<Object>(std::make_shared<::coal::Box>(1, 1, 1)); }
  static void set(Object& object, const std::array<Scalar, 3>& lo, const std::array<Scalar, 3>& hi) {
    object.getAABB().min_ = ::coal::Vec3s(lo[0], lo[1], lo[2]);
    object.getAABB().max_ = ::coal::Vec3s(hi[0], hi[1], hi[2]);
  }
  template <class OnPair, class... Of>
  static void collide(const Base& manager, OnPair&& on_pair, Of&... of) {
    Collide<std::remove_reference_t<OnPair>> callback(on_pair);
    manager.collide(&of..., &callback);
    EXPECT_EQ(callback.inits, 1) << "of an empty manager, too";
  }
  template <class OnPair, class... Of>
  static void distance(const Base& manager, OnPair&& on_pair, Of&... of) {
    Distance<std::remove_reference_t<OnPair>> callback(on_pair);
    manager.distance(&of..., &callback);
    EXPECT_EQ(callback.inits, 1) << "of an empty manager, too";
  }
};

INSTANTIATE_TYPED_TEST_SUITE_P(Coal, Contract, Coal);

TEST(Coal, ObjectsAreGivenTwoWays) {
  Contract<Coal>::Crowd crowd(5);
  boxstream::coal::CollisionManager manager;
  EXPECT_TRUE(manager.getObjects().empty());
  manager.registerObjects(crowd.objects);
  const ::coal::BroadPhaseCollisionManager& as_base = manager;
  EXPECT_EQ(manager.getObjects(), crowd.objects);
  EXPECT_EQ(as_base.getObjects(), crowd.objects);
  std::vector<CollisionObject*> objects;
  as_base.getObjects(objects);
  EXPECT_EQ(objects, crowd.objects);
}

}  // namespace
}  // namespace boxstream::managers_test
