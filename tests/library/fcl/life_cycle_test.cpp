// SPDX-License-Identifier: MIT
// Every order of registering, updating and unregistering, against brute force over the boxes last read. Calls are
// compared one by one: that is which pairs, in which order, with which object first.
#include "sanitized.hpp"
#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

template <class S>
struct LifeCycle : ::testing::Test {};
TYPED_TEST_SUITE(LifeCycle, Scalars);

template <class S>
void expect_all(const Manager<S>& manager, const Oracle<S>& oracle, BoxObject<S>& query, Manager<S>& other,
                const Oracle<S>& other_oracle) {
  EXPECT_EQ(manager.size(), oracle.entries.size());
  EXPECT_EQ(manager.empty(), oracle.entries.empty());
  std::vector<Object<S>*> objects(3), expected;
  manager.getObjects(objects);
  for (const auto& entry : oracle.entries) expected.push_back(entry.object);
  EXPECT_EQ(objects, expected);
  EXPECT_CALLS(collide<S>(manager), oracle.collide());
  EXPECT_CALLS(collide<S>(manager, query), oracle.collide(query));
  EXPECT_CALLS(collide<S>(manager, other), oracle.collide(other_oracle));
}

/// A run of random calls. `size` is how many objects there are, managed or not.
template <class S>
void live(unsigned seed, std::size_t size, int steps, bool setup_first) {
  SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(size) + " objects");
  std::mt19937 random(seed);
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const int cells = 2 + static_cast<int>(std::cbrt(static_cast<double>(size)) * 2);
  Scene<S> scene;
  for (std::size_t i = 0; i < size; ++i) scene.add(random_grid_box<S>(random, cells, 2));
  Manager<S> manager, other;
  Oracle<S> oracle, other_oracle;
  if (setup_first) manager.setup();

  for (int step = 0; step < steps && !::testing::Test::HasFailure(); ++step) {
    SCOPED_TRACE("step " + std::to_string(step));
    const auto pick = [&]() -> BoxObject<S>& { return scene[below(size)]; };
    std::vector<Object<S>*> some;
    for (std::size_t i = 0, count = below(size / 2 + 1); i < count; ++i) some.push_back(&pick());
    switch (below(12)) {
      case 0: {
        BoxObject<S>& object = pick();
        manager.registerObject(&object);
        oracle.put(object);
        break;
      }
      case 1:
      case 2:  // in bulk, with objects that are managed already, and some named twice
        manager.registerObjects(some);
        for (Object<S>* object : some) oracle.put(*static_cast<BoxObject<S>*>(object));
        break;
      case 3: {
        BoxObject<S>& object = pick();
        manager.unregisterObject(&object);  // known or not
        oracle.erase(object);
        break;
      }
      case 4:
        for (Object<S>* object : some) {
          manager.unregisterObject(object);
          manager.unregisterObject(object);
          oracle.erase(*static_cast<BoxObject<S>*>(object));
        }
        break;
      case 5:  // objects move without a call to the manager
      case 6:
        for (Object<S>* object : some) static_cast<BoxObject<S>*>(object)->set(random_grid_box<S>(random, cells, 2));
        break;
      case 7: {
        BoxObject<S>& object = pick();
        object.set(random_grid_box<S>(random, cells, 2));
        manager.update(&object);
        oracle.look(object);
        break;
      }
      case 8:
        manager.update(some);
        for (Object<S>* object : some) oracle.look(*static_cast<BoxObject<S>*>(object));
        break;
      case 9:
        manager.update();
        oracle.look();
        break;
      case 10:
        if (below(8) == 0) {
          manager.clear();
          oracle.entries.clear();
        } else {
          manager.setup();
        }
        break;
      default: {  // the other manager shares objects with the first
        BoxObject<S>& object = pick();
        other.registerObject(&object);
        other_oracle.put(object);
        break;
      }
    }
    ASSERT_NO_THROW(manager.validate());
    if (below(3) == 0) expect_all<S>(manager, oracle, pick(), other, other_oracle);
    ASSERT_NO_THROW(manager.validate());
  }
  expect_all<S>(manager, oracle, scene[0], other, other_oracle);
}

TYPED_TEST(LifeCycle, C2_C3_C5_RandomCallsOnAFewObjects) {
  for (unsigned seed = 0; seed < 40; ++seed) live<TypeParam>(seed, 4 + seed % 29, 120, seed % 2 == 0);
}

TYPED_TEST(LifeCycle, C2_C3_C5_RandomCallsOnManyObjects) {
  for (unsigned seed = 100; seed < (tests::sanitized ? 101 : 104); ++seed) live<TypeParam>(seed, 300, 150, false);
}

TYPED_TEST(LifeCycle, C2_UpdateOfAllIsUpdateOfEach) {
  using S = TypeParam;
  std::mt19937 random(7);
  Scene<S> scene(random_cubes<S>(200, 3, random));
  Manager<S> at_once, listed, one_by_one;
  for (Manager<S>* manager : {&at_once, &listed, &one_by_one}) manager->registerObjects(scene.pointers());
  for (int frame = 0; frame < 5; ++frame) {
    const std::vector<FclBox<S>> boxes = random_cubes<S>(200, 3, random);
    for (std::size_t i = 0; i < boxes.size(); ++i) scene[i].set(boxes[i]);
    at_once.update();
    listed.update(scene.pointers());
    for (Object<S>* object : scene.pointers()) one_by_one.update(object);
    const Calls calls = collide<S>(at_once);
    EXPECT_GT(calls.size(), 100U);
    EXPECT_CALLS(collide<S>(listed), calls);
    EXPECT_CALLS(collide<S>(one_by_one), calls);
  }
}

/// FCL's trees take a move of less than 100 epsilons for none.
TYPED_TEST(LifeCycle, C2_TheSmallestMoveIsSeen) {
  using S = TypeParam;
  const S far_off = S(1e6);
  const S gap = std::nextafter(far_off, inf<S>);
  Scene<S> scene({make_box<S>(0, 0, 0, far_off, 1, 1), make_box<S>(gap, 0, 0, 2 * far_off, 1, 1)});
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  EXPECT_TRUE(collide<S>(manager).empty());
  scene[1].set(make_box<S>(far_off, 0, 0, 2 * far_off, 1, 1));
  manager.update(&scene[1]);
  EXPECT_EQ(collide<S>(manager).size(), 1U);
  scene[1].set(make_box<S>(gap, 0, 0, 2 * far_off, 1, 1));
  manager.update(&scene[1]);
  EXPECT_TRUE(collide<S>(manager).empty());
}

TYPED_TEST(LifeCycle, C3_AnEmptyManagerAnswers) {
  using S = TypeParam;
  Scene<S> scene({cube<S>(0, 0, 0)});
  Manager<S> manager, other;
  manager.setup();
  manager.update();
  manager.registerObjects({});
  manager.update(&scene[0]);
  manager.unregisterObject(&scene[0]);
  EXPECT_TRUE(manager.empty());
  EXPECT_TRUE(collide<S>(manager).empty());
  EXPECT_TRUE(collide<S>(manager, scene[0]).empty());
  EXPECT_TRUE(collide<S>(manager, other).empty());
  other.registerObject(&scene[0]);
  EXPECT_TRUE(collide<S>(manager, other).empty());
  EXPECT_TRUE(collide<S>(other, manager).empty());
  Calls calls;
  manager.distance(&calls, record_distance<S>);
  manager.distance(&scene[0], &calls, record_distance<S>);
  manager.distance(&other, &calls, record_distance<S>);
  other.distance(&manager, &calls, record_distance<S>);
  EXPECT_TRUE(calls.empty());
}

/// MoveIt moves an object by taking it out and putting it in again.
TYPED_TEST(LifeCycle, C5_RegisteredAgainAndAgain) {
  using S = TypeParam;
  std::mt19937 random(3);
  Scene<S> scene(random_cubes<S>(150, 3, random));
  Manager<S> manager;
  Oracle<S> oracle;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    manager.registerObject(&scene[i]);
    oracle.put(scene[i]);
  }
  for (std::size_t turn = 0; turn < 2000; ++turn) {
    BoxObject<S>& object = scene[turn * 7 % scene.size()];
    object.set(random_cubes<S>(1, 8.0 / 400, random)[0]);
    manager.unregisterObject(&object);
    manager.registerObject(&object);
    oracle.erase(object);
    oracle.put(object);
    if (turn % 97 == 0) {
      EXPECT_CALLS(collide<S>(manager, object), oracle.collide(object));
      EXPECT_CALLS(collide<S>(manager), oracle.collide());
    }
  }
  EXPECT_CALLS(collide<S>(manager), oracle.collide());
}

/// 1000 boxes, so that all ways of finding pairs are taken: rows first, then the batch, then what is held.
TYPED_TEST(LifeCycle, LargerSetsOverManyFrames) {
  using S = TypeParam;
  std::mt19937 random(11);
  for (const double pairs : {0.5, 6.0, 60.0}) {
    const std::vector<FclBox<S>> boxes = random_cubes<S>(tests::sanitized ? 300 : 1000, pairs, random);
    Scene<S> scene(boxes);
    Manager<S> manager;
    manager.registerObjects(scene.pointers());
    Oracle<S> oracle;
    for (std::size_t i = 0; i < scene.size(); ++i) oracle.put(scene[i]);
    std::uniform_real_distribution<double> move(-0.2, 0.2);
    for (int frame = 0; frame < 6; ++frame) {
      const std::size_t step = frame % 3 == 0 ? 1 : frame % 3 == 1 ? 100 : 1001;  // all move, some, none
      for (std::size_t i = 0; i < boxes.size(); i += step) {
        FclBox<S> box = boxes[i];
        const auto by = static_cast<S>(move(random));
        box.min_.array() += by;
        box.max_.array() += by;
        scene[i].set(box);
      }
      manager.update();
      oracle.look();
      const Calls expected = oracle.collide();
      EXPECT_CALLS(collide<S>(manager), expected);
      EXPECT_CALLS(collide<S>(manager), expected);
      for (std::size_t i = 0; i < scene.size(); i += 50)
        EXPECT_CALLS(collide<S>(manager, scene[i]), oracle.collide(scene[i]));
    }
  }
}

}  // namespace
}  // namespace boxstream::fcl_test
