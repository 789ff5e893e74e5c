// SPDX-License-Identifier: MIT
// What a broad phase can do for a hard pose: deliver it, once, the same way round every time.
#include <fcl/geometry/shape/sphere.h>

#include <boxstream/fcl.hpp>
#include <boxstream/fcl/tight_box.hpp>
#include <random>

#include "every_pose.hpp"
#include "fcl_objects.hpp"
#include "truth.hpp"

namespace boxstream::poses {
namespace {

template <class S>
using Object = ::fcl::CollisionObject<S>;
template <class S>
using Manager = boxstream::fcl::CollisionManager<S>;
template <class S>
using BoxSource = typename Manager<S>::BoxSource;

/// The two objects of a pose among others that are far away.
template <class S>
struct Crowd {
  explicit Crowd(const HardPose& pose) : a(object<S>(pose.a)), b(object<S>(pose.b)) {
    const auto ball = std::make_shared<::fcl::Sphere<S>>(S(1));
    for (int i = 0; i < 20; ++i) {
      ::fcl::Transform3<S> place = ::fcl::Transform3<S>::Identity();
      place.translation() = ::fcl::Vector3<S>(S(1e5), S(1e5), S(1e5 + 10 * i));
      others.push_back(std::make_unique<Object<S>>(ball, place));
    }
  }

  std::vector<Object<S>*> in_order(unsigned seed) const {
    std::vector<Object<S>*> objects{a.get(), b.get()};
    for (const auto& other : others) objects.push_back(other.get());
    std::mt19937 random(seed);
    if (seed > 0) std::shuffle(objects.begin(), objects.end(), random);
    return objects;
  }

  std::unique_ptr<Object<S>> a, b;
  std::vector<std::unique_ptr<Object<S>>> others;
};

/// Calls with the pair: "ab" or "ba" each.
template <class S>
struct Calls {
  const Crowd<S>& crowd;
  std::string text{};

  void add(Object<S>* first, Object<S>* second) {
    if (first == crowd.a.get() && second == crowd.b.get()) text += "ab ";
    if (first == crowd.b.get() && second == crowd.a.get()) text += "ba ";
  }
};

template <class S>
bool on_collide(Object<S>* first, Object<S>* second, void* calls) {
  static_cast<Calls<S>*>(calls)->add(first, second);
  return false;
}
template <class S>
bool on_distance(Object<S>* first, Object<S>* second, void* calls, S&) {
  static_cast<Calls<S>*>(calls)->add(first, second);
  return false;
}

template <class S, class... Args>
std::string collide(const Crowd<S>& crowd, const Manager<S>& manager, Args... with) {
  Calls<S> calls{crowd};
  manager.collide(with..., &calls, on_collide<S>);
  return calls.text;
}
template <class S, class... Args>
std::string distance(const Crowd<S>& crowd, const Manager<S>& manager, Args... with) {
  Calls<S> calls{crowd};
  manager.distance(with..., &calls, on_distance<S>);
  return calls.text;
}

/// One manager of all, in several orders of registration, asked three times; then a query by object and by manager.
/// `touches` says whether the boxes do.
template <class S>
void expect_once(const Crowd<S>& crowd, BoxSource<S> source, bool touches) {
  for (const unsigned seed : {0U, 1U, 2U, 3U}) {
    SCOPED_TRACE(testing::Message() << "order " << seed);
    Manager<S> manager;
    if (source) manager.setBoxSource(source);
    const std::vector<Object<S>*> objects = crowd.in_order(seed);
    if (seed % 2 == 0)
      manager.registerObjects(objects);
    else
      for (Object<S>* const object : objects) manager.registerObject(object);
    const bool a_first = std::find(objects.begin(), objects.end(), crowd.a.get()) <
                         std::find(objects.begin(), objects.end(), crowd.b.get());
    const std::string once = a_first ? "ab " : "ba ";
    for (int run = 0; run < 3; ++run) {
      EXPECT_EQ(distance(crowd, manager), once);
      EXPECT_EQ(collide(crowd, manager), touches ? once : "");
      manager.update();
    }
  }
  Manager<S> with_a, with_b;
  for (Manager<S>* const manager : {&with_a, &with_b})
    if (source) manager->setBoxSource(source);
  with_a.registerObject(crowd.a.get());
  with_b.registerObject(crowd.b.get());
  EXPECT_EQ(distance(crowd, with_a, crowd.b.get()), "ab ");
  EXPECT_EQ(distance(crowd, with_b, crowd.a.get()), "ba ");
  EXPECT_EQ(distance(crowd, with_a, static_cast<::fcl::BroadPhaseCollisionManager<S>*>(&with_b)), "ab ");
  EXPECT_EQ(collide(crowd, with_a, crowd.b.get()), touches ? "ab " : "");
  EXPECT_EQ(collide(crowd, with_b, static_cast<::fcl::BroadPhaseCollisionManager<S>*>(&with_a)), touches ? "ba " : "");
}

template <class S>
void expect_delivered(const HardPose& pose) {
  const Crowd<S> crowd(pose);
  const bool cubes_touch = crowd.a->getAABB().overlap(crowd.b->getAABB());
  const auto tight = boxstream::fcl::tightBox<S>;
  const bool boxes_touch = tight(*crowd.a).overlap(tight(*crowd.b));
  // FCL makes its boxes with plain rounding, so only shapes that overlap by more than that are sure to have boxes that
  // do. Ours are rounded outward: in double precision touching is enough, in single the pose itself is rounded.
  const double rounding = 16 * std::numeric_limits<S>::epsilon() *
                          (extent(pose.a, pose.b) + pose.a.translation.norm() + pose.b.translation.norm());
  if (pose.truth < -rounding) {
    EXPECT_TRUE(cubes_touch);
    EXPECT_TRUE(boxes_touch);
  }
  if (std::is_same_v<S, double> && pose.truth <= 0) {
    EXPECT_TRUE(boxes_touch);
  }
  expect_once<S>(crowd, nullptr, cubes_touch);
  expect_once<S>(crowd, tight, boxes_touch);
}

struct Delivered : testing::TestWithParam<HardPose> {};
TEST_P(Delivered, OnceInDouble) {
  expect_delivered<double>(GetParam());
}
TEST_P(Delivered, OnceInFloat) {
  expect_delivered<float>(GetParam());
}
BOXSTREAM_FOR_EVERY_POSE(Delivered);

}  // namespace
}  // namespace boxstream::poses
