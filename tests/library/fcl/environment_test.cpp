// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment: which boxes touch does not depend on it.
#include <functional>
#include <random>

#include "core/box_sets.hpp"
#include "float_environment.hpp"
#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

using namespace tests;

template <class S>
struct Environment : ::testing::Test {};
TYPED_TEST_SUITE(Environment, Scalars);

template <class S>
using Frame = std::vector<FclBox<S>>;

/// Hard numbers, infinite, denormal and NaN ones among them, for each frame. Made in the default environment.
template <class S>
std::vector<Frame<S>> frames(std::size_t n) {
  std::vector<Frame<S>> all(4);
  for (std::size_t f = 0; f < all.size(); ++f)
    for (const char* name : {"ties", "denormals", "infinite", "invalid_among_valid", "full_range", "one_step_apart"})
      for (const auto& box : box_set<S>(name).make(n, f / 2))
        all[f].push_back(make_box<S>(box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]));
  return all;
}

/// What every kind of collide query says in each frame, query by query.
template <class S>
std::vector<Calls> history(
    const std::vector<Frame<S>>& all, const std::function<unsigned()>& mood = [] { return 0u; }) {
  std::vector<Calls> log;
  const auto third = static_cast<std::ptrdiff_t>(all[2].size() / 3);
  Scene<S> scene(all[0]), others(Frame<S>(all[2].begin(), all[2].begin() + third));
  Manager<S> manager, other;
  manager.registerObjects(scene.pointers());
  other.registerObjects(others.pointers());
  for (const Frame<S>& boxes : all) {
    for (std::size_t i = 0; i < boxes.size(); ++i) scene[i].set(boxes[i]);
    const auto in_some_mood = [&](const auto& call) {
      const Mood now(mood());
      call();
    };
    in_some_mood([&] { manager.update(); });
    for (int again = 0; again < 3; ++again) in_some_mood([&] { log.push_back(collide<S>(manager)); });
    in_some_mood([&] { log.push_back(collide<S>(manager, other)); });
    for (std::size_t i = 0; i < boxes.size(); i += 7)
      in_some_mood([&] { log.push_back(collide<S>(manager, scene[i])); });
  }
  return log;
}

/// Calls `compare(found, expected)` for each query.
template <class S, class Compare>
void compare_within(const std::function<void(const std::function<void()>&)>& environment, Compare compare) {
  for (const std::size_t n : {5, 60}) {
    const std::vector<Frame<S>> all = frames<S>(n);
    const std::vector<Calls> expected = history<S>(all);
    EXPECT_GT(expected[0].size(), n);
    std::vector<Calls> found;
    environment([&] { found = history<S>(all); });
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) compare(found[i], expected[i]);
  }
}

void expect_same(const Calls& found, const Calls& expected) {
  EXPECT_CALLS(found, expected);
}

/// What one query finds and keeps, in its environment, is used by the next one in another.
TYPED_TEST(Environment, SwitchedFromCallToCall) {
  for (const std::size_t n : {5, 60}) {
    const std::vector<Frame<TypeParam>> all = frames<TypeParam>(n);
    const std::vector<Calls> expected = history<TypeParam>(all);
    for (unsigned seed = 1; seed < 6; ++seed) {
      std::minstd_rand random(seed);
      const std::vector<Calls> found =
          history<TypeParam>(all, [&] { return static_cast<unsigned>(random() >> 8) % Mood::count; });
      for (std::size_t i = 0; i < found.size(); ++i) expect_same(found[i], expected[i]);
    }
  }
}

TYPED_TEST(Environment, AnyRoundingMode) {
  for (const int mode : rounding_modes)
    compare_within<TypeParam>([=](const auto& work) { with_rounding(mode, work); }, expect_same);
}

#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
TYPED_TEST(Environment, DenormalsFlushedToZero) {
  compare_within<TypeParam>(with_denormals_flushed, expect_same);
}
#endif

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
TYPED_TEST(Environment, FloatingPointExceptionsUnmasked) {
  compare_within<TypeParam>([](const auto& work) { with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, work); },
                            expect_same);
}

/// Every call with a special value at every place; what was counted.
template <class S>
std::size_t call_all(const std::vector<S>& special_values, S margin) {
  std::size_t count = 0;
  Scene<S> scene;
  for (int i = 0; i < 120; ++i) scene.add(make_box<S>(S(i), 0, 0, S(i + 1), 1, 1));
  Manager<S> manager, other;
  manager.setMargin(margin);
  manager.registerObjects(scene.pointers());
  other.registerObject(&scene[7]);
  for (const S& special : special_values)
    for (int place = 0; place < 6; ++place) {
      FclBox<S> box = make_box<S>(1, 1, 1, 2, 2, 2);
      (place < 3 ? box.min_ : box.max_)[place % 3] = special;
      BoxObject<S>& object = scene[std::size_t(20 * place)];
      for (int again = 0; again < 3; ++again) {
        object.set(box);
        manager.update(&object);
        count += collide<S>(manager).size() + collide<S>(manager, object).size() + collide<S>(manager, other).size();
        object.set(make_box<S>(special, special, special, special, special, special));
        manager.update();
        count += collide<S>(manager, object).size();
      }
      const auto keep_going = [](Object<S>*, Object<S>*, void* answer, S& distance) {
        distance = *static_cast<S*>(answer);
        return false;
      };
      S answer = special;
      manager.distance(&answer, keep_going);
      manager.distance(&object, &answer, keep_going);
      manager.distance(&other, &answer, keep_going);
      const ::fcl::Vector3<S> low = box.min_, high = box.max_;
      const auto seen = [&](const Object<S>*, S) { return ++count == 0; };
      manager.rayCast(low, high, seen);
      manager.rayCast(high, low, seen);
      manager.rayCast(low, -low, seen);
    }
  return count;
}

TYPED_TEST(Environment, NoCallTrapsForAnySpecialValue) {
  using S = TypeParam;
  using Limits = std::numeric_limits<S>;
  const std::vector<S> special_values = {0,
                                         -S(0),
                                         Limits::denorm_min(),
                                         -Limits::denorm_min(),
                                         S(1e18),
                                         S(-1e30),
                                         largest<S>,
                                         -largest<S>,
                                         inf<S>,
                                         -inf<S>,
                                         nan<S>,
                                         Limits::signaling_NaN()};
  for (const S margin : special_values) {
    const std::size_t expected = call_all<S>(special_values, margin);
    EXPECT_GT(expected, 1000u);
    std::size_t found = 0;
    with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, [&] { found = call_all<S>(special_values, margin); });
    EXPECT_EQ(found, expected) << "margin " << margin;
  }
}

/// The way from one end of the range to the other is no number of the scalar.
TYPED_TEST(Environment, RayAcrossTheWholeRange) {
  using S = TypeParam;
  const S far = largest<S> / 8 * 7;
  Scene<S> scene;
  scene.add(make_box<S>(far / 2, -1, -1, far / 2, 1, 1));
  scene.add(make_box<S>(far / 2, 5, 5, far / 2, 6, 6));
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  std::vector<S> hits;
  manager.rayCast({-far, 0, 0}, {far, 0, 0}, [&](const Object<S>*, S enter) {
    hits.push_back(enter);
    return false;
  });
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_NEAR(double(hits[0]), 0.75, 1e-6);
}
#endif

}  // namespace
}  // namespace boxstream::fcl_test
