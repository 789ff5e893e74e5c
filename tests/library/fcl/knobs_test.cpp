// SPDX-License-Identifier: MIT
// Histories in which every knob is turned at any time, between registering, updating and asking.
#include <utility>

#include "model.hpp"
#include "sanitized.hpp"

namespace boxstream::fcl_test {
namespace {

using boxstream::fcl::Groups;

template <class S>
struct Knobs : ::testing::Test {};
TYPED_TEST_SUITE(Knobs, Scalars);

TYPED_TEST(Knobs, ANewMarginReachesStaticObjectsAtTheNextUpdate) {
  using S = TypeParam;
  Scene<S> ground({cube<S>(0, 0, 0)}), moving({cube<S>(S(1.45), 0, 0)});
  Manager<S> manager;
  manager.registerStaticObjects(ground.pointers());
  manager.registerObjects(moving.pointers());
  manager.setMargin(S(0.5));
  EXPECT_TRUE(collide<S>(manager).empty());
  manager.update();
  EXPECT_CALLS(collide<S>(manager), (Calls{{0, 0}}));
  ground[0].set(cube<S>(9, 9, 9));  // and not at those that follow
  manager.update();
  EXPECT_CALLS(collide<S>(manager), (Calls{{0, 0}}));
  manager.setMargin(0);
  ground[0].set(cube<S>(0, 0, 0));
  manager.update();
  EXPECT_TRUE(collide<S>(manager).empty());
}

TYPED_TEST(Knobs, ANewSourceReachesStaticObjectsAtTheNextUpdate) {
  using S = TypeParam;
  Scene<S> ground({cube<S>(0, 0, 0)}), moving({cube<S>(S(1.45), 0, 0)});
  Manager<S> manager;
  manager.registerStaticObjects(ground.pointers());
  manager.registerObjects(moving.pointers());
  manager.setBoxSource([](const Object<S>& object) {
    FclBox<S> box = object.getAABB();
    return box.expand(::fcl::Vector3<S>::Constant(S(0.25)));
  });
  manager.update();
  EXPECT_CALLS(collide<S>(manager), (Calls{{0, 0}}));
}

TYPED_TEST(Knobs, AMarginBeyondAllNumbersIsTheLargest) {
  using S = TypeParam;
  Scene<S> scene({cube<S>(0, 0, 0), cube<S>(largest<S> / 4, 0, 0), make_box<S>(inf<S>, 0, 0, inf<S>, 1, 1)});
  Manager<S> manager;
  manager.setMargin(inf<S>);
  manager.registerObjects(scene.pointers());
  EXPECT_CALLS(collide<S>(manager), (Calls{{0, 1}, {0, 2}, {1, 2}}));
}

template <class S>
FclBox<S> flat(const Object<S>& object) {
  FclBox<S> box = object.getAABB();
  box.max_[2] = box.min_[2];
  return box;
}

Calls in_order(Calls calls) {
  std::sort(calls.begin(), calls.end());
  return calls;
}

/// A manager and what it is to say, and objects that may be in it.
template <class S>
class History {
 public:
  History(unsigned seed, std::size_t size) : random_(seed), cells_(2 + static_cast<int>(2 * std::cbrt(double(size)))) {
    for (std::size_t i = 0; i < size; ++i) scene_.add(random_grid_box<S>(random_, cells_, 2));
  }

  void step() {
    BoxObject<S>& object = any();
    switch (below(15)) {
      case 0:
        manager_.registerObject(&object);
        model_.put(object);
        break;
      case 1:
        manager_.registerObjects(some());
        each_of_some([&](auto& one) { model_.put(one); });
        break;
      case 2:
        manager_.registerStaticObjects(some());
        each_of_some([&](auto& one) { model_.put_static(one); });
        break;
      case 3:
        manager_.unregisterObject(&object);
        model_.erase(object);
        break;
      case 4:
        manager_.update(&object);
        model_.look(object);
        break;
      case 5:
        manager_.update(some());
        each_of_some([&](auto& one) { model_.look(one); });
        break;
      case 6:
        manager_.update();
        model_.look();
        break;
      case 7: {
        const Groups groups{static_cast<std::uint16_t>(1 + below(3)), static_cast<std::uint16_t>(1 + below(3))};
        EXPECT_EQ(manager_.setGroups(&object, groups), model_.set_groups(object, groups));
        break;
      }
      case 8: {
        const bool is_static = below(2) == 0;
        EXPECT_EQ(manager_.setStatic(&object, is_static), model_.set_static(object, is_static));
        break;
      }
      case 9: {
        const S margin = std::vector<S>{0, 1, 2, S(1.5), nan<S>, -1}[below(6)];
        manager_.setMargin(margin);
        model_.set_margin(margin);
        break;
      }
      case 10: {
        const auto source = below(2) == 0 ? &flat<S> : nullptr;
        manager_.setBoxSource(source);
        model_.set_source(source);
        break;
      }
      case 11:
        if (below(8) != 0) break;
        manager_.clear();
        model_.clear();
        break;
      case 12: {
        Manager<S> moved(std::move(manager_));
        EXPECT_TRUE(manager_.empty() && collide<S>(manager_).empty() && collide<S>(manager_, object).empty());
        if (below(2) == 0) manager_.registerObject(&object);  // it may be used on
        if (below(2) == 0) collide<S>(manager_, object);
        manager_ = std::move(moved);
        break;
      }
      default:  // objects move, and the manager is not told
        some();
        each_of_some([&](auto& one) { one.set(random_grid_box<S>(random_, cells_, 2)); });
    }
  }

  /// Asks one thing or all: what one query leaves behind must not show in another.
  void ask() {
    const std::size_t which = below(5);
    const auto is_asked = [which](std::size_t i) { return which == i || which == 4; };
    BoxObject<S>& object = any();
    Calls far, far_one;
    if (is_asked(0)) {
      EXPECT_CALLS(collide<S>(manager_), model_.collide());
    }
    if (is_asked(1)) {
      EXPECT_CALLS(collide<S>(manager_, object), model_.collide(object));
    }
    if (is_asked(2)) {
      manager_.distance(&far, record_distance<S>);
      EXPECT_CALLS(in_order(far), in_order(model_.all_pairs().all));
    }
    if (is_asked(3)) {
      manager_.distance(&object, &far_one, record_distance<S>);
      EXPECT_CALLS(in_order(far_one), in_order(model_.all_pairs(object).all));
    }
    ASSERT_NO_THROW(manager_.validate());
  }

  std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

 private:
  BoxObject<S>& any() { return scene_[below(scene_.size())]; }
  const std::vector<Object<S>*>& some() {
    picked_.clear();
    for (std::size_t i = 0, count = below(scene_.size() / 2 + 1); i < count; ++i) picked_.push_back(&any());
    return picked_;
  }
  template <class Use>
  void each_of_some(Use use) {
    for (Object<S>* const object : picked_) use(*static_cast<BoxObject<S>*>(object));
  }

  std::mt19937 random_;
  int cells_;
  Scene<S> scene_;
  Manager<S> manager_;
  Model<S> model_;
  std::vector<Object<S>*> picked_;
};

template <class S>
void live(unsigned seed, std::size_t size, int steps) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  History<S> history(seed, size);
  for (int step = 0; step < steps && !::testing::Test::HasFailure(); ++step) {
    history.step();
    if (history.below(2) == 0) history.ask();
  }
}

TYPED_TEST(Knobs, AnyOrderOnAFewObjects) {
  for (unsigned seed = 0; seed < (tests::sanitized ? 10 : 60); ++seed) live<TypeParam>(seed, 4 + seed % 20, 150);
}

TYPED_TEST(Knobs, AnyOrderOnManyObjects) {
  for (unsigned seed = 100; seed < (tests::sanitized ? 101 : 104); ++seed) live<TypeParam>(seed, 250, 120);
}

}  // namespace
}  // namespace boxstream::fcl_test
