// SPDX-License-Identifier: MIT
// The manager as a C++ type among FCL's: sources of boxes, foreign managers, overloads, layout, ownership.
#include <dlfcn.h>

#include <type_traits>

#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>

#include "sanitized.hpp"
#include "support.hpp"

#ifdef __AVX__
#error "Files that include FCL are compiled for the baseline: Eigen's alignment is part of its library's ABI"
#endif

namespace boxstream::fcl_test {
namespace {

template <class S>
struct Interface : ::testing::Test {};
TYPED_TEST_SUITE(Interface, Scalars);

TYPED_TEST(Interface, C1_BoxesAreNeverRecomputed) {
  using S = TypeParam;
  const auto geometry = std::make_shared<::fcl::Box<S>>(S(1), S(1), S(1));
  Object<S> far_off(geometry, ::fcl::Matrix3<S>::Identity(), ::fcl::Vector3<S>(100, 0, 0)), near_by(geometry);
  near_by.computeAABB();
  far_off.computeAABB();
  Manager<S> manager;
  manager.registerObjects({&near_by, &far_off});
  std::size_t calls = 0;
  const auto count = [](Object<S>*, Object<S>*, void* data) {
    ++*static_cast<std::size_t*>(data);
    return false;
  };
  far_off.setTranslation(::fcl::Vector3<S>(S(0.5), 0, 0));  // its box stays where it was
  manager.update();
  manager.update(&far_off);
  manager.collide(&calls, count);
  manager.collide(&far_off, &calls, count);
  EXPECT_EQ(calls, 0U);
  far_off.computeAABB();
  manager.collide(&calls, count);  // C2: the managed box is still the old one
  EXPECT_EQ(calls, 0U);
  manager.collide(&far_off, &calls, count);  // the query's is the new one
  EXPECT_EQ(calls, 1U);
  manager.update();
  manager.collide(&calls, count);
  EXPECT_EQ(calls, 2U);
}

TYPED_TEST(Interface, C4_ObjectsMayBeGoneFirst) {
  using S = TypeParam;
  std::mt19937 random(2);
  for (const std::size_t size : {10, 200}) {
    Scene<S> scene(random_cubes<S>(size, 3, random)), rest(random_cubes<S>(size, 3, random));
    Manager<S> manager, cleared, destroyed;
    for (Manager<S>* each : {&manager, &cleared, &destroyed}) {
      each->registerObjects(scene.pointers());
      EXPECT_FALSE(collide<S>(*each).empty());
      EXPECT_FALSE(collide<S>(*each, scene[0]).empty() && collide<S>(*each, scene[1]).empty() &&
                   collide<S>(*each, scene[2]).empty());
    }
    manager.registerObjects(rest.pointers());
    for (Object<S>* object : scene.pointers()) manager.unregisterObject(object);
    scene.free_all();
    for (Object<S>* object : scene.pointers()) manager.unregisterObject(object);  // once more, unknown and dead
    Oracle<S> oracle;
    for (std::size_t i = 0; i < rest.size(); ++i) oracle.put(rest[i]);
    EXPECT_CALLS(collide<S>(manager), oracle.collide());
    cleared.clear();
    EXPECT_TRUE(cleared.empty());
    EXPECT_TRUE(collide<S>(cleared).empty());
    cleared.registerObjects(rest.pointers());
    EXPECT_CALLS(collide<S>(cleared), oracle.collide());
  }
}

/// A user's manager that appends to the list, with more than one object or none.
TYPED_TEST(Interface, C13_AForeignManagerThatAddsItsObjects) {
  using S = TypeParam;
  struct Adding : ::fcl::NaiveCollisionManager<S> {
    void getObjects(std::vector<Object<S>*>& objects) const override {
      std::vector<Object<S>*> mine;
      ::fcl::NaiveCollisionManager<S>::getObjects(mine);
      objects.insert(objects.end(), mine.begin(), mine.end());
    }
    using ::fcl::NaiveCollisionManager<S>::getObjects;
  };
  Scene<S> scene({cube<S>(0, 0, 0), cube<S>(0, 0, 0), cube<S>(0, 0, 0)});
  Manager<S> manager;
  manager.registerObject(&scene[0]);
  Adding adding;
  EXPECT_TRUE(collide<S>(manager, adding).empty());
  adding.registerObject(&scene[1]);
  adding.registerObject(&scene[2]);
  EXPECT_CALLS(collide<S>(manager, adding), (Calls{{0, 1}, {0, 2}}));
}

/// FCL's managers read what is not there in an `other` of ours. They look first if one of the two is empty.
TYPED_TEST(Interface, C13_OursAsTheOtherOfTheirs) {
  using S = TypeParam;
  Scene<S> scene({cube<S>(0, 0, 0), cube<S>(0, 0, 0)});
  Manager<S> ours, empty;
  ours.registerObject(&scene[0]);
  ::fcl::DynamicAABBTreeCollisionManager<S> tree, full;
  ::fcl::NaiveCollisionManager<S> naive;
  full.registerObject(&scene[1]);
  if (!boxstream::tests::sanitized) {  // these see the cast that FCL makes before it looks
    EXPECT_TRUE(collide<S>(tree, ours).empty());
    EXPECT_TRUE(collide<S>(naive, ours).empty());
    EXPECT_TRUE(collide<S>(full, empty).empty());
  }
  EXPECT_CALLS(collide<S>(ours, full), (Calls{{0, 1}}));  // the way to ask
}

TYPED_TEST(Interface, MayBeMovedInEveryState) {
  using S = TypeParam;
  static_assert(std::is_nothrow_move_constructible_v<Manager<S>> && std::is_nothrow_move_assignable_v<Manager<S>>);
  static_assert(std::is_nothrow_swappable_v<Manager<S>>);
  std::mt19937 random(9);
  Scene<S> scene(random_cubes<S>(300, 5, random)), few(random_cubes<S>(20, 5, random));
  const auto filled = [&](Scene<S>& with) {
    Manager<S> manager;
    manager.registerObjects(with.pointers());
    return manager;  // by value
  };
  for (Scene<S>* const each : {&scene, &few}) {
    const Manager<S> reference = filled(*each);
    const Calls pairs = collide<S>(reference), one = collide<S>(reference, (*each)[3]);
    for (const bool asked : {false, true}) {
      std::vector<Manager<S>> managers;
      for (int i = 0; i < 5; ++i) {  // moved as the vector grows
        managers.push_back(filled(*each));
        if (asked) {
          EXPECT_CALLS(collide<S>(managers.back()), pairs);
        }
      }
      managers[0] = std::move(managers[4]);
      managers[1] = std::move(managers[1]);
      std::swap(managers[2], managers[3]);
      EXPECT_TRUE(managers[4].empty() && collide<S>(managers[4]).empty());
      managers[4].registerObject(&scene[0]);
      EXPECT_EQ(managers[4].size(), 1U);
      for (int i = 0; i < 4; ++i) {
        Manager<S>& manager = managers[static_cast<std::size_t>(i)];
        EXPECT_CALLS(collide<S>(manager), pairs);
        EXPECT_CALLS(collide<S>(manager, (*each)[3]), one);
        ASSERT_NO_THROW(manager.validate());
      }
    }
  }
}

/// What is set, and what a manager was told of its objects, moves with it.
TYPED_TEST(Interface, KnobsMoveToo) {
  using S = TypeParam;
  Scene<S> scene({cube<S>(0, 0, 0), cube<S>(S(1.25), 0, 0), cube<S>(0, 0, 0)});
  Manager<S> manager;
  manager.tree_init_level = 2;
  manager.setMargin(S(0.5));
  manager.registerObjects(scene.pointers());
  manager.setPairFilter([](const Object<S>* a, const Object<S>*) { return name_of(a) != 1; });
  manager.setGroups(&scene[2], {2, 2});
  Manager<S> moved;
  moved = std::move(manager);
  EXPECT_CALLS(collide<S>(moved), (Calls{{0, 1}}));
  EXPECT_EQ(moved.tree_init_level, 2);
  EXPECT_EQ(manager.tree_init_level, 0);
  manager.registerObjects(scene.pointers());
  EXPECT_CALLS(collide<S>(manager), (Calls{{0, 2}}));  // neither margin nor filter nor groups
}

/// Each overload on the concrete type; a manager that overrides one of them only would not compile.
TYPED_TEST(Interface, C15_AllOverloadsAreVisible) {
  using S = TypeParam;
  static_assert(!std::is_copy_constructible_v<Manager<S>> && !std::is_copy_assignable_v<Manager<S>>);
  static_assert(std::is_default_constructible_v<Manager<S>>);
  static_assert(std::has_virtual_destructor_v<Manager<S>> && std::is_base_of_v<Base<S>, Manager<S>>);
  Scene<S> scene({cube<S>(0, 0, 0), cube<S>(0, 0, 0)});
  Manager<S> manager;
  std::vector<Object<S>*> objects = scene.pointers();
  manager.registerObjects(objects);
  manager.registerObject(objects[0]);
  manager.setup();
  manager.update();
  manager.update(objects[0]);
  manager.update(objects);
  Calls calls;
  manager.collide(&calls, record<S>);
  manager.collide(objects[0], &calls, record<S>);
  manager.collide(static_cast<Base<S>*>(&manager), &calls, record<S>);
  manager.distance(&calls, record_distance<S>);
  manager.distance(objects[0], &calls, record_distance<S>);
  manager.distance(static_cast<Base<S>*>(&manager), &calls, record_distance<S>);
  EXPECT_EQ(calls.size(), 6U);
  manager.getObjects(objects);
  EXPECT_EQ(objects, scene.pointers());
  EXPECT_EQ(manager.size(), 2U);
  std::unique_ptr<Base<S>> as_base = std::make_unique<Manager<S>>();
  as_base->registerObjects(objects);
  EXPECT_EQ(collide<S>(*as_base).size(), 1U);
}

TYPED_TEST(Interface, C16_ObjectsInThreeManagersKeepWhatIsTheirs) {
  using S = TypeParam;
  std::mt19937 random(6);
  Scene<S> scene(random_cubes<S>(100, 4, random));
  int data[2] = {1, 2};
  std::vector<FclBox<S>> boxes;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    scene[i].setUserData(&data[i % 2]);
    boxes.push_back(scene[i].getAABB());
  }
  Manager<S> managers[3];
  for (Manager<S>& manager : managers) manager.registerObjects(scene.pointers());
  const Calls calls = collide<S>(managers[0]);
  managers[1].unregisterObject(&scene[0]);
  managers[1].clear();
  EXPECT_CALLS(collide<S>(managers[2]), calls);
  EXPECT_CALLS(collide<S>(managers[0]), calls);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    EXPECT_EQ(scene[i].getUserData(), &data[i % 2]);
    EXPECT_TRUE(scene[i].getAABB().min_ == boxes[i].min_ && scene[i].getAABB().max_ == boxes[i].max_);
  }
}

template <class S>
Calls calls_of(Manager<S>& manager, Object<S>& object) {
  Calls calls;
  manager.collide(&object, &calls, record<S>);
  return calls;
}
template <class S>
Calls calls_of(Manager<S>& manager, Manager<S>& other) {
  Calls calls;
  manager.collide(&other, &calls, record<S>);
  return calls;
}

/// Names are numbers in the order of registration, so what is in order is sorted.
TYPED_TEST(Interface, OrderOfRegistrationIfAskedFor) {
  using S = TypeParam;
  std::mt19937 random(13);
  for (const std::size_t size : {20, 400, 3000}) {
    Scene<S> scene(random_cubes<S>(size, 3, random));
    Manager<S> all, few;
    all.registerObjects(scene.pointers());
    for (std::size_t i = 0; i < size; i += 20) few.registerObject(&scene[i]);
    BoxObject<S> large(cube<S>(2, 2, 2, S(3)), -1);
    bool is_sorted = true;
    for (const bool ordered : {true, false, true}) {
      all.setRegistrationOrder(ordered);
      few.setRegistrationOrder(ordered);
      for (int repeat = 0; repeat < 80; ++repeat) {
        for (const Calls& calls : {calls_of(all, large), calls_of(all, few), calls_of(few, all)}) {
          if (ordered) {
            ASSERT_CALLS(calls, in_any_order(calls));
          }
          is_sorted &= calls == in_any_order(calls);
        }
        const Calls self = collide<S>(all);
        ASSERT_CALLS(self, in_any_order(self));
      }
    }
    EXPECT_EQ(is_sorted, size == 20) << "nothing to be put in order";
  }
}

/// The same calls on two managers, whose objects have addresses in another order.
TYPED_TEST(Interface, Determinism_OfAHistory) {
  using S = TypeParam;
  std::mt19937 random(14);
  const std::vector<FclBox<S>> boxes = random_cubes<S>(1500, 5, random);
  std::vector<std::size_t> order(boxes.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::vector<Calls> histories[2];
  for (std::vector<Calls>& history : histories) {
    std::vector<std::unique_ptr<BoxObject<S>>> objects(boxes.size());
    for (const std::size_t i : order) objects[i] = std::make_unique<BoxObject<S>>(boxes[i], static_cast<int>(i));
    std::shuffle(order.begin(), order.end(), random);
    Manager<S> manager, other;
    for (std::size_t i = 0; i < boxes.size(); ++i) (i % 9 == 0 ? other : manager).registerObject(objects[i].get());
    for (std::size_t round = 0; round < 60; ++round) {
      if (round % 2 == 1) {
        objects[round]->set(boxes[2 * round]);
        manager.update(objects[round].get());
      }
      history.push_back(calls_of(manager, *objects[7 * round]));
      history.push_back(calls_of(manager, other));
      history.push_back(collide<S>(manager));
      Calls distances;
      manager.distance(objects[round].get(), &distances, record_distance<S>);
      history.push_back(distances);
    }
  }
  for (std::size_t i = 0; i < histories[0].size(); ++i) ASSERT_CALLS(histories[1][i], histories[0][i]);
}

TYPED_TEST(Interface, Determinism_UpdatesAndAddressesDoNotMatter) {
  using S = TypeParam;
  std::mt19937 random(12);
  const std::vector<FclBox<S>> boxes = random_cubes<S>(400, 5, random);
  Calls self, one, distances;
  for (int round = 0; round < 4; ++round) {
    // The same boxes in the same order, at addresses in another order.
    std::vector<std::unique_ptr<BoxObject<S>>> objects(boxes.size());
    std::vector<std::size_t> order(boxes.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    if (round > 0) std::shuffle(order.begin(), order.end(), random);
    for (const std::size_t i : order) objects[i] = std::make_unique<BoxObject<S>>(boxes[i], static_cast<int>(i));
    Manager<S> manager;
    for (const auto& object : objects) manager.registerObject(object.get());
    for (int repeat = 0; repeat < 100; ++repeat) {
      manager.update();
      const Calls now = collide<S>(manager);
      if (self.empty()) {
        self = now;
        one = collide<S>(manager, *objects[5]);
        manager.distance(objects[5].get(), &distances, record_distance<S>);
      }
      ASSERT_CALLS(now, self);
      ASSERT_CALLS(collide<S>(manager, *objects[5]), one);
      Calls again;
      manager.distance(objects[5].get(), &again, record_distance<S>);
      ASSERT_CALLS(again, distances);
    }
  }
  EXPECT_GT(self.size(), 500U);
}

/// The library's functions put the last member where we read it.
TEST(Layout, C18_ObjectsHaveTheLayoutOfTheLibrary) {
  using SetUserData = void (*)(Object<double>*, void*);
  const auto set = reinterpret_cast<SetUserData>(dlsym(RTLD_DEFAULT, "_ZN3fcl15CollisionObjectIdE11setUserDataEPv"));
  ASSERT_NE(set, nullptr);
  BoxObject<double> object(cube<double>(0, 0, 0));
  int data = 0;
  set(&object, &data);
  EXPECT_EQ(object.getUserData(), &data);
  using Compute = void (*)(Object<double>*);
  const auto compute = reinterpret_cast<Compute>(dlsym(RTLD_DEFAULT, "_ZN3fcl15CollisionObjectIdE11computeAABBEv"));
  ASSERT_NE(compute, nullptr);
  compute(&object);
  EXPECT_TRUE(object.getAABB().max_ == ::fcl::Vector3d(1, 1, 1));
#if defined(__x86_64__)
  EXPECT_EQ(sizeof(Object<double>), 224U);
  EXPECT_EQ(alignof(Object<double>), 16U);
#endif
}

}  // namespace
}  // namespace boxstream::fcl_test
