// SPDX-License-Identifier: MIT
// Boxes and calls that are known to be hard for a broad-phase, against brute force.
#include <numeric>
#include <utility>

#include "core/box_sets.hpp"
#include "core/random.hpp"
#include "sanitized.hpp"
#include "small_stack.hpp"
#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

using boxstream::fcl::Groups;
using tests::box_set;
using tests::box_sets_to_repeat;

template <class S>
struct HardBoxes : ::testing::Test {};
TYPED_TEST_SUITE(HardBoxes, Scalars);

template <class S>
FclBox<S> to_box(const BasicAabb<S>& box) {
  return make_box<S>(box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]);
}

template <class S>
std::vector<FclBox<S>> boxes_of(const std::string& set, std::size_t n, std::uint64_t seed) {
  std::vector<FclBox<S>> boxes;
  for (const auto& box : box_set<S>(set).make(n, seed)) boxes.push_back(to_box<S>(box));
  return boxes;
}

/// A scene, its manager and brute force over what the manager last read.
template <class S>
struct Watched {
  explicit Watched(const std::vector<FclBox<S>>& boxes, const DetectorOptions& options = {})
      : scene(boxes), manager(options) {
    manager.registerObjects(scene.pointers());
    for (std::size_t i = 0; i < scene.size(); ++i) oracle.put(scene[i]);
  }
  void update() {
    manager.update();
    oracle.look();
  }
  void expect_right() {
    ASSERT_NO_THROW(manager.validate());
    ASSERT_CALLS(collide<S>(manager), oracle.collide());
    for (std::size_t i = 0; i < scene.size(); i += scene.size() / 8 + 1)
      ASSERT_CALLS(collide<S>(manager, scene[i]), oracle.collide(scene[i]));
    ASSERT_NO_THROW(manager.validate());
  }

  Scene<S> scene;
  Manager<S> manager;
  Oracle<S> oracle;
};

/// Each family of box sets: all new, all moved to another set of the family, a few moved back, and against each other.
TYPED_TEST(HardBoxes, EveryBoxSet) {
  using S = TypeParam;
  for (const auto& set : box_sets_to_repeat<S>())
    for (const std::size_t n : {40, 250}) {
      SCOPED_TRACE(set.name + " of " + std::to_string(n));
      const auto first = boxes_of<S>(set.name, n, 1), second = boxes_of<S>(set.name, n, 2);
      Watched<S> watched(first), other(second);
      watched.expect_right();
      ASSERT_CALLS(collide<S>(watched.manager, other.manager), watched.oracle.collide(other.oracle));
      for (std::size_t i = 0; i < n; ++i) watched.scene[i].set(second[i]);
      watched.update();
      watched.expect_right();
      for (std::size_t i = 0; i < n; i += 19) watched.scene[i].set(first[i]);
      watched.update();
      watched.expect_right();
      if (this->HasFailure()) return;
    }
}

/// The same of managers on the paper's tree, in the order of a planned one.
TYPED_TEST(HardBoxes, EveryBoxSetByTheHybridMethod) {
  using S = TypeParam;
  DetectorOptions options;
  options.method = Method::hybrid;
  for (const auto& set : box_sets_to_repeat<S>())
    for (const std::uint32_t cutoff : {0u, 16u}) {
      SCOPED_TRACE(set.name + ", cutoff " + std::to_string(cutoff));
      options.cutoff = cutoff;
      const auto first = boxes_of<S>(set.name, 250, 1), second = boxes_of<S>(set.name, 250, 2);
      Watched<S> watched(first, options), other(second, options), planned(first);
      watched.expect_right();
      EXPECT_CALLS(collide<S>(watched.manager), collide<S>(planned.manager));
      ASSERT_CALLS(collide<S>(watched.manager, other.manager), watched.oracle.collide(other.oracle));
      for (std::size_t i = 0; i < first.size(); ++i) watched.scene[i].set(second[i]);
      watched.update();
      watched.expect_right();
      if (this->HasFailure()) return;
    }
}

TYPED_TEST(HardBoxes, SizesUpTo130) {
  using S = TypeParam;
  for (const char* name : {"dense", "ties", "identical"}) {
    if (tests::sanitized && std::string(name) != "ties") continue;
    SCOPED_TRACE(name);
    Watched<S> watched({});
    watched.expect_right();
    for (const auto& box : boxes_of<S>(name, 130, 1)) {  // and each size on the way
      BoxObject<S>& object = watched.scene.add(box);
      watched.manager.registerObject(&object);
      watched.oracle.put(object);
      watched.expect_right();
    }
    for (std::size_t i = 0; i < 130; ++i) {
      BoxObject<S>& object = watched.scene[i * 37 % 130];
      watched.manager.unregisterObject(&object);
      watched.oracle.erase(object);
      watched.expect_right();
      if (this->HasFailure()) return;
    }
    EXPECT_TRUE(watched.manager.empty());
  }
}

/// The pairs of all others are the same before a bound becomes NaN, meanwhile and after.
TYPED_TEST(HardBoxes, NanOnAnySideDisturbsNoOtherPair) {
  using S = TypeParam;
  const auto boxes = boxes_of<S>("dense", 150, 3);
  Watched<S> watched(boxes);
  const int victim = 70;
  const auto of_others = [](Calls calls) {
    calls.erase(std::remove_if(calls.begin(), calls.end(),
                               [](const auto& call) { return call.first == victim || call.second == victim; }),
                calls.end());
    return calls;
  };
  const Calls before = collide<S>(watched.manager);
  ASSERT_GT(before.size(), of_others(before).size());
  for (int side = 0; side < 6; ++side)
    for (const S value : {nan<S>, -nan<S>, std::numeric_limits<S>::signaling_NaN()}) {
      SCOPED_TRACE(side);
      FclBox<S> bad = boxes[victim];
      (side < 3 ? bad.min_ : bad.max_)[side % 3] = value;
      watched.scene[victim].set(bad);
      watched.update();
      watched.expect_right();
      ASSERT_CALLS(of_others(collide<S>(watched.manager)), of_others(before));
      watched.scene[victim].set(boxes[victim]);
      watched.update();
      ASSERT_CALLS(collide<S>(watched.manager), before);
    }
}

TYPED_TEST(HardBoxes, BoxesThatChangePlaces) {
  using S = TypeParam;
  auto boxes = boxes_of<S>("dense", 200, 4);
  Watched<S> watched(boxes);
  tests::Random random(5);
  for (int frame = 0; frame < 12; ++frame) {
    for (int swap = 0; swap < 1 + 4 * frame; ++swap) {
      const std::size_t i = random.index(200), j = random.index(200);
      std::swap(boxes[i], boxes[j]);
      watched.scene[i].set(boxes[i]);
      watched.scene[j].set(boxes[j]);
    }
    watched.update();
    watched.expect_right();
    if (this->HasFailure()) return;
  }
}

/// Objects are told by address: one that takes the place of another in memory is a new one if the old one was
/// unregistered, and a box that changed if it was not.
TYPED_TEST(HardBoxes, AddressesThatAreUsedAgain) {
  using S = TypeParam;
  Scene<S> others(boxes_of<S>("dense", 100, 6));
  Manager<S> manager;
  Oracle<S> oracle;
  manager.registerObjects(others.pointers());
  for (std::size_t i = 0; i < others.size(); ++i) oracle.put(others[i]);
  alignas(BoxObject<S>) std::byte memory[sizeof(BoxObject<S>)];
  tests::Random random(7);
  BoxObject<S>* object = nullptr;
  for (int turn = 0; turn < 60; ++turn) {
    const bool unregister = turn % 3 != 0;
    if (object != nullptr) {
      if (unregister) {
        manager.unregisterObject(object);
        oracle.erase(*object);
      }
      object->~BoxObject<S>();
    }
    object = new (memory) BoxObject<S>(others[random.index(100)].getAABB(), 1000 + turn);
    manager.registerObject(object);
    oracle.put(*object);
    ASSERT_NO_THROW(manager.validate());
    ASSERT_CALLS(collide<S>(manager), oracle.collide());
    ASSERT_CALLS(collide<S>(manager, others[0]), oracle.collide(others[0]));
  }
  manager.unregisterObject(object);
  object->~BoxObject<S>();
}

/// The order of registration decides the order of calls, never which they are.
TYPED_TEST(HardBoxes, ShuffledRegistrationGivesTheSamePairs) {
  using S = TypeParam;
  tests::Random random(8);
  for (const char* name : {"dense", "ties", "rods_mixed"}) {
    const auto boxes = boxes_of<S>(name, 400, 1);
    Scene<S> scene(boxes);
    Oracle<S> oracle;
    for (std::size_t i = 0; i < scene.size(); ++i) oracle.put(scene[i]);
    const Calls truth = sorted(oracle.collide());
    std::vector<std::size_t> order(boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (int round = 0; round < 5; ++round) {
      random.shuffle(order);
      Manager<S> manager;
      for (const std::size_t i : order) manager.registerObject(&scene[i]);
      ASSERT_CALLS(sorted(collide<S>(manager)), truth);
    }
  }
}

TYPED_TEST(HardBoxes, QueriesFitOnASmallStack) {
  using S = TypeParam;
  for (const char* name : {"dense", "comb_and_plates_z", "nested", "rods_mixed"}) {
    SCOPED_TRACE(name);
    const std::size_t n = std::min<std::size_t>(17000, box_set<S>(name).largest);
    Scene<S> scene(boxes_of<S>(name, n, 1)), others(boxes_of<S>(name, n / 3, 2));
    Manager<S> elsewhere, other;
    elsewhere.registerObjects(scene.pointers());
    other.registerObjects(others.pointers());
    const Calls self = collide<S>(elsewhere), cross = collide<S>(elsewhere, other);
    Calls found, found_cross, found_one, near;
    std::size_t on_ray = 0;
    tests::on_small_stack([&] {
      Manager<S> manager;
      manager.registerObjects(scene.pointers());
      found = collide<S>(manager);
      found_cross = collide<S>(manager, other);
      found_one = collide<S>(manager, scene[0]);
      manager.distance(&near, [](Object<S>* a, Object<S>* b, void* data, S&) {
        record<S>(a, b, data);
        return static_cast<Calls*>(data)->size() == 50;
      });
      manager.rayCast(scene[0].getAABB().min_, scene[0].getAABB().max_, [&](Object<S>*, S) { return ++on_ray == 0; });
      manager.update();
    });
    EXPECT_CALLS(found, self);
    EXPECT_CALLS(found_cross, cross);
    EXPECT_CALLS(found_one, collide<S>(elsewhere, scene[0]));
    EXPECT_EQ(near.size(), 50u);
    EXPECT_GE(on_ray, 1u);
  }
}

/// On a grid, along axes, of no length, through faces, edges and corners; inverses of powers of two are exact.
TYPED_TEST(HardBoxes, GrazingRaysAreExactWhereNothingIsRounded) {
  using S = TypeParam;
  tests::Random random(9);
  Scene<S> scene;
  for (int i = 0; i < 200; ++i) {
    FclBox<S> box;
    for (int d = 0; d < 3; ++d) {
      box.min_[d] = static_cast<S>(random.integer(-6, 6));
      box.max_[d] = box.min_[d] + static_cast<S>(random.integer(0, 3));
    }
    scene.add(box);
  }
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  const int steps[] = {0, 0, 1, -1, 2, -4, 8};
  std::size_t hits = 0, of_no_length = 0;
  for (int ray = 0; ray < 2000; ++ray) {
    ::fcl::Vector3<S> from, to;
    for (int d = 0; d < 3; ++d) {
      from[d] = static_cast<S>(random.integer(-8, 8));
      to[d] = from[d] + static_cast<S>(steps[random.index(std::size(steps))]);
    }
    std::vector<bool> met(scene.size());
    manager.rayCast(from, to, [&](Object<S>* object, S) {
      met[static_cast<std::size_t>(name_of(object))] = true;
      return false;
    });
    for (std::size_t i = 0; i < scene.size(); ++i) {
      S enter = 0, leave = 1;
      for (int d = 0; d < 3; ++d) {
        const S low = scene[i].getAABB().min_[d] - from[d], high = scene[i].getAABB().max_[d] - from[d];
        const S way = to[d] - from[d];
        if (way == 0) {
          if (low > 0 || high < 0) leave = -1;
          continue;
        }
        enter = std::max(enter, std::min(low / way, high / way));
        leave = std::min(leave, std::max(low / way, high / way));
      }
      ASSERT_EQ(met[i], enter <= leave) << "ray " << ray << ", box " << i;
      hits += met[i];
      of_no_length += met[i] && from == to;
    }
  }
  EXPECT_GT(hits, 1000u);
  EXPECT_GT(of_no_length, 10u);
}

/// Calls of a query that is stopped after `most` of them.
template <class S>
struct FirstCalls {
  std::size_t most;
  Calls calls;

  static bool record(Object<S>* a, Object<S>* b, void* data) {
    auto& self = *static_cast<FirstCalls*>(data);
    self.calls.push_back({name_of(a), name_of(b)});
    return self.calls.size() == self.most;
  }
};

/// More pairs of two managers than are ever held: few of one against many of the other, both ways, and as many.
TYPED_TEST(HardBoxes, ManyPairsOfTwoManagersAtOnePlace) {
  using S = TypeParam;
  for (const std::pair<int, int>& sizes : {std::pair(8000, 300), std::pair(1200, 1200), std::pair(20, 4000)}) {
    const int n = sizes.first, m = sizes.second;
    std::vector<FclBox<S>> boxes(static_cast<std::size_t>(n + m), cube<S>(0, 0, 0));
    boxes[5] = cube<S>(9, 9, 9);
    boxes[static_cast<std::size_t>(n) + 7] = make_box<S>(1, 1, 1, -1, -1, -1);
    Scene<S> scene(boxes);
    Manager<S> manager, other;
    for (int i = 0; i < n + m; ++i) (i < n ? manager : other).registerObject(&scene[static_cast<std::size_t>(i)]);
    manager.setGroups(&scene[3], {2, 2});
    other.setGroups(&scene[static_cast<std::size_t>(n) + 1], {2, 2});
    manager.setRegistrationOrder(true);
    std::size_t count = 0, next = 0, wrong = 0;
    const auto meet = [&](int i, int j) { return i != 5 && j != n + 7 && (i == 3) == (j == n + 1); };
    struct Walk {
      std::size_t &count, &next, &wrong;
      int n, m;
      const decltype(meet)& pairs;
    } walk{count, next, wrong, n, m, meet};
    manager.collide(&other, &walk, [](Object<S>* a, Object<S>* b, void* data) {
      auto& w = *static_cast<Walk*>(data);
      const auto place = [&] {
        return std::pair(static_cast<int>(w.next) / w.m, w.n + static_cast<int>(w.next) % w.m);
      };
      while (!w.pairs(place().first, place().second)) ++w.next;
      w.wrong += place() != std::pair(name_of(a), name_of(b));
      ++w.next;
      ++w.count;
      return false;
    });
    EXPECT_EQ(wrong, 0u) << n << " against " << m;
    EXPECT_EQ(count, static_cast<std::size_t>(n - 2) * static_cast<std::size_t>(m - 2) + 1) << n << " against " << m;
  }
}

TYPED_TEST(HardBoxes, AnEmptyManagerMeetsNothing) {
  using S = TypeParam;
  Scene<S> scene({cube<S>(0, 0, 0)});
  Manager<S> manager, empty;
  manager.registerObjects(scene.pointers());
  EXPECT_TRUE(collide<S>(manager, empty).empty());
  EXPECT_TRUE(collide<S>(empty, manager).empty());
}

/// More pairs than are held, and a query that is stopped at any of them.
TYPED_TEST(HardBoxes, StopsAmongManyPairsAtOnePlace) {
  using S = TypeParam;
  const int n = 2000;
  Scene<S> scene(std::vector<FclBox<S>>(n, cube<S>(0, 0, 0)));
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  for (const std::size_t most : {1, 2, n - 1, n, 3 * n, 100 * n}) {
    FirstCalls<S> first{most, {}};
    manager.collide(&first, FirstCalls<S>::record);
    ASSERT_EQ(first.calls.size(), most);
    std::size_t at = 0;
    for (int i = 0; at < most; ++i)
      for (int j = i + 1; j < n && at < most; ++j) ASSERT_EQ(first.calls[at++], std::pair(i, j));
  }
}

/// Objects that are gone, boxes that are none, and a source in place of the objects' own boxes.
TYPED_TEST(HardBoxes, StaleBoxesThatAreNone) {
  using S = TypeParam;
  using Stale = typename Manager<S>::Stale;
  Scene<S> scene(std::vector<FclBox<S>>(4, cube<S>(0, 0, 0)));
  Manager<S> manager;
  manager.setBoxSource([](const Object<S>& object) { return object.getAABB(); });
  manager.registerObjects(scene.pointers());
  manager.unregisterObject(&scene[1]);
  const auto stale = [&] {
    std::vector<int> names;
    manager.findStale([&](const Object<S>* object, Stale kind) {
      EXPECT_EQ(kind, Stale::not_updated);
      names.push_back(name_of(object));
    });
    return names;
  };
  EXPECT_TRUE(stale().empty());
  scene[0].set(make_box<S>(1, 1, 1, -1, -1, -1));
  EXPECT_EQ(stale(), std::vector<int>{0});
  manager.update();
  EXPECT_TRUE(stale().empty());
  scene[0].set(make_box<S>(2, 2, 2, -2, -2, -2));
  EXPECT_TRUE(stale().empty()) << "one box that touches nothing for another";
  scene[0].set(cube<S>(0, 0, 0));
  EXPECT_EQ(stale(), std::vector<int>{0});
}

/// Few that move and change their groups, while the rest stays: the index takes in these only.
TYPED_TEST(HardBoxes, FewMoveAndChangeGroups) {
  using S = TypeParam;
  std::vector<FclBox<S>> boxes;
  for (int i = 0; i < 400; ++i) boxes.push_back(cube<S>(S(i % 20), S(i / 20), 0));
  Scene<S> scene(boxes);
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  manager.setGroups(&scene[7], {2, 2});
  for (int round = 0; round < 6; ++round) {
    const auto moved = static_cast<std::size_t>(30 * round + 5);
    scene[moved].set(cube<S>(10, 10, 0));
    manager.setGroups(&scene[moved], {static_cast<std::uint16_t>(1 + round % 2), 0xffff});
    manager.update(&scene[moved]);
    BoxObject<S> query(cube<S>(10, 10, 0), 999);
    Calls calls;
    manager.collide(&query, Groups{1, 1}, &calls, record<S>);
    Calls right;
    for (std::size_t i = 0; i < 400; ++i) {
      const bool was_moved = i >= 5 && (i - 5) % 30 == 0 && (i - 5) / 30 <= static_cast<std::size_t>(round);
      const bool is_in_group_1 = i == 7 ? false : !was_moved || (i - 5) / 30 % 2 == 0;
      if (is_in_group_1 && touch<S>(scene[i].getAABB(), query.getAABB())) right.push_back({static_cast<int>(i), 999});
    }
    ASSERT_CALLS(calls, right) << "round " << round;
    ASSERT_NO_THROW(manager.validate());
  }
}

}  // namespace
}  // namespace boxstream::fcl_test
