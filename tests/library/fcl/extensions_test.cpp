// SPDX-License-Identifier: MIT
// What the manager offers beyond FCL's interface.
#include <cmath>
#include <functional>
#include <string>

#include <fcl/geometry/shape/box.h>

#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

using boxstream::fcl::Groups;

template <class S>
struct Extensions : ::testing::Test {};
TYPED_TEST_SUITE(Extensions, Scalars);

template <class Keep>
Calls filtered(Calls calls, Keep keep) {
  calls.erase(
      std::remove_if(calls.begin(), calls.end(), [&](const auto& call) { return !keep(call.first, call.second); }),
      calls.end());
  return calls;
}

template <class S>
struct Two {
  explicit Two(std::size_t size) {
    std::mt19937 random(17);
    for (const FclBox<S>& box : random_cubes<S>(size + size / 2, 8, random)) {
      scene.add(box);
      Manager<S>& of = scene.size() <= size ? manager : other;
      of.registerObject(&scene[scene.size() - 1]);
    }
    self = collide<S>(manager);
    one = collide<S>(manager, scene[2]);
    cross = collide<S>(manager, other);
    manager.distance(&far, record_distance<S>);
    manager.distance(&scene[2], &far_one, record_distance<S>);
    manager.distance(&other, &far_cross, record_distance<S>);
  }

  /// All queries give what they gave at first, as far as `keep` accepts it.
  template <class Keep>
  void expect(Keep keep, bool is_symmetric = true) {
    EXPECT_CALLS(collide<S>(manager), filtered(self, keep));
    EXPECT_CALLS(collide<S>(manager, other), filtered(cross, keep));
    Calls is;
    manager.distance(&is, record_distance<S>);
    EXPECT_CALLS(in_any_order(is), in_any_order(filtered(far, keep)));  // with an index, later, it is another one
    is.clear();
    manager.distance(&other, &is, record_distance<S>);
    EXPECT_CALLS(in_any_order(is), in_any_order(filtered(far_cross, keep)));  // a pair of those that are kept is first
    if (!is_symmetric) return;
    EXPECT_CALLS(collide<S>(manager, scene[2]), filtered(one, keep));
    is.clear();
    manager.distance(&scene[2], &is, record_distance<S>);
    EXPECT_CALLS(is, filtered(far_one, keep));
  }

  Scene<S> scene;
  Manager<S> manager, other;
  Calls self, one, cross, far, far_one, far_cross;
};

TYPED_TEST(Extensions, PairFilter) {
  using S = TypeParam;
  for (const std::size_t size : {30, 200}) {
    Two<S> two(size);
    std::size_t asked = 0;
    const auto keep = [](int a, int b) { return (a + b) % 3 != 0; };
    two.manager.setPairFilter([&](const Object<S>* a, const Object<S>* b) {
      ++asked;
      return keep(name_of(a), name_of(b));
    });
    two.expect(keep);
    asked = 0;
    collide<S>(two.manager);
    EXPECT_EQ(asked, two.self.size());
    two.manager.setPairFilter({});
    two.expect([](int, int) { return true; });
  }
}

TYPED_TEST(Extensions, GroupsAndStaticObjects) {
  using S = TypeParam;
  for (const std::size_t size : {30, 200}) {
    Two<S> two(size);
    std::mt19937 random(1);
    std::vector<Groups> groups(two.scene.size());
    std::vector<bool> is_static(two.scene.size(), false);
    for (int round = 0; round < 4; ++round) {
      for (std::size_t i = 0; i < two.scene.size(); ++i) {
        if (random() % 3 != 0) continue;
        Manager<S>& of = i < size ? two.manager : two.other;
        groups[i] = {static_cast<std::uint16_t>(random()), static_cast<std::uint16_t>(random() & random())};
        if (round == 3) groups[i] = {};
        EXPECT_TRUE(of.setGroups(&two.scene[i], groups[i]));
        if (round < 1 || i >= size || i == 2) continue;
        is_static[i] = random() % 2 == 0;
        EXPECT_TRUE(of.setStatic(&two.scene[i], is_static[i]));
      }
      two.expect([&](int x, int y) {
        const auto a = static_cast<std::size_t>(x), b = static_cast<std::size_t>(y);
        const bool meet = (groups[a].group & groups[b].mask) != 0 && (groups[b].group & groups[a].mask) != 0;
        return meet && !(is_static[a] && is_static[b]);
      });
    }
    EXPECT_FALSE(two.manager.setGroups(&two.scene[size], {}));
    EXPECT_FALSE(two.manager.setStatic(&two.scene[size]));
  }
}

// A manager none of whose objects has groups keeps no bits for them; those of the other side count all the same.
TYPED_TEST(Extensions, GroupsOfOneSideOnly) {
  using S = TypeParam;
  for (const std::size_t size : {6, 30, 200, 600})
    for (const bool mine : {true, false}) {
      SCOPED_TRACE(std::to_string(size) + (mine ? ", mine" : ", theirs"));
      Two<S> two(size);
      const std::size_t first = mine ? 0 : size, last = mine ? size : two.scene.size();
      std::vector<Groups> groups(two.scene.size());
      std::vector<bool> is_static(two.scene.size(), false);
      for (std::size_t i = first; i < last; ++i) {
        Manager<S>& of = mine ? two.manager : two.other;
        if (i % 3 == 0) groups[i] = {4, 0xfffe};
        is_static[i] = i % 4 == 1;
        EXPECT_TRUE(of.setGroups(&two.scene[i], groups[i]));
        EXPECT_TRUE(of.setStatic(&two.scene[i], is_static[i]));
      }
      two.expect(
          [&](int x, int y) {
            const auto a = static_cast<std::size_t>(x), b = static_cast<std::size_t>(y);
            const bool meet = (groups[a].group & groups[b].mask) != 0 && (groups[b].group & groups[a].mask) != 0;
            return meet && !(is_static[a] && is_static[b]);
          },
          false);
    }
}

TYPED_TEST(Extensions, GroupsOfAQuery) {
  using S = TypeParam;
  Scene<S> scene(std::vector<FclBox<S>>(3, cube<S>(0, 0, 0)));
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  BoxObject<S> shy(cube<S>(0, 0, 0), 8);
  Calls none;
  manager.collide(&shy, Groups{1, 2}, &none, record<S>);  // all managed objects are in group 1
  manager.distance(&shy, Groups{1, 2}, &none, record_distance<S>);
  EXPECT_CALLS(none, Calls{});
  manager.setGroups(&scene[0], {1, 2});
  manager.setGroups(&scene[1], {2, 1});
  manager.setStatic(&scene[1]);
  BoxObject<S> query(cube<S>(0, 0, 0), 9);
  EXPECT_CALLS(collide<S>(manager, query), (Calls{{1, 9}, {2, 9}}));
  Calls calls;
  manager.collide(&query, Groups{2, 0xffff}, &calls, record<S>);
  EXPECT_CALLS(calls, (Calls{{0, 9}, {2, 9}}));
  calls.clear();
  manager.distance(&query, Groups{2, 1}, &calls, record_distance<S>);
  EXPECT_CALLS(calls, (Calls{{0, 9}, {2, 9}}));
  EXPECT_CALLS(collide<S>(manager, scene[1]), (Calls{{0, 1}, {2, 1}}));  // static as a managed object, not as a query
}

TYPED_TEST(Extensions, StaticObjectsStayWhereTheyWereRead) {
  using S = TypeParam;
  Scene<S> ground({cube<S>(0, 0, 0), cube<S>(0, 0, 0), cube<S>(9, 0, 0)}), moving;
  moving.add(cube<S>(5, 0, 0));
  Manager<S> manager;
  manager.registerStaticObjects(ground.pointers());
  manager.registerObjects(moving.pointers());
  EXPECT_TRUE(collide<S>(manager).empty());
  ground[2].set(cube<S>(5, 0, 0));
  manager.update();
  EXPECT_TRUE(collide<S>(manager).empty());
  manager.update(&ground[2]);
  EXPECT_CALLS(collide<S>(manager), (Calls{{2, 0}}));
  moving[0].set(cube<S>(0, 0, 0));
  manager.update();
  EXPECT_CALLS(collide<S>(manager), (Calls{{0, 0}, {1, 0}}));
}

TYPED_TEST(Extensions, Margin) {
  using S = TypeParam;
  const S gap = S(0.25);
  Scene<S> scene({cube<S>(0, 0, 0), cube<S>(1 + gap, 0, 0), cube<S>(3 + gap, 3, 3)});
  Manager<S> manager, other;
  manager.setMargin(gap);
  manager.registerObjects(scene.pointers());
  EXPECT_CALLS(collide<S>(manager), (Calls{{0, 1}}));
  EXPECT_CALLS(collide<S>(manager, scene[1]), (Calls{{0, 1}}));
  manager.setMargin(gap * (1 - 8 * std::numeric_limits<S>::epsilon()));
  manager.update();
  EXPECT_TRUE(collide<S>(manager).empty());
  manager.setMargin(nan<S>);
  manager.update();
  scene[1].set(cube<S>(1, 0, 0));
  manager.update();
  EXPECT_CALLS(collide<S>(manager), (Calls{{0, 1}}));
  scene[0].set(make_box<S>(1, 0, 0, 0, 1, 1));  // inside out, and not to be turned by a margin
  manager.setMargin(10);
  manager.update();
  EXPECT_CALLS(collide<S>(manager), (Calls{{1, 2}}));
}

TYPED_TEST(Extensions, RayCast) {
  using S = TypeParam;
  std::mt19937 random(14);
  for (const std::size_t size : {20, 400}) {
    Scene<S> scene(random_cubes<S>(size, 3, random));
    Manager<S> manager;
    manager.registerObjects(scene.pointers());
    const double side = std::cbrt(8.0 * static_cast<double>(size) / 3);
    std::uniform_real_distribution<double> at(-1, side + 1);
    std::size_t hits = 0;
    for (int ray = 0; ray < 200; ++ray) {
      ::fcl::Vector3<S> from, to;
      for (int d = 0; d < 3; ++d) {
        from[d] = static_cast<S>(at(random));
        to[d] = ray % 5 == d ? from[d] : static_cast<S>(at(random));  // some along the axes
      }
      std::vector<std::pair<int, S>> is;
      manager.rayCast(from, to, [&](Object<S>* object, S t) {
        is.push_back({name_of(object), t});
        return false;
      });
      for (std::size_t i = 1; i < is.size(); ++i) ASSERT_LE(is[i - 1].second, is[i].second);
      // Where the ray enters by more than rounding, and where it misses by more.
      for (std::size_t i = 0; i < scene.size(); ++i) {
        long double enter = 0, leave = 1;
        for (int d = 0; d < 3; ++d) {
          const long double low = scene[i].getAABB().min_[d], high = scene[i].getAABB().max_[d];
          const long double start = from[d], way = static_cast<long double>(to[d]) - start;
          if (way == 0) {
            if (start < low || start > high) leave = -1;
            continue;
          }
          enter = std::max(enter, std::min((low - start) / way, (high - start) / way));
          leave = std::min(leave, std::max((low - start) / way, (high - start) / way));
        }
        const auto found = std::find_if(is.begin(), is.end(), [&](const auto& hit) { return hit.first == int(i); });
        const long double rounding = 64 * std::numeric_limits<S>::epsilon();
        if (enter < leave - rounding) {
          ASSERT_NE(found, is.end()) << "ray " << ray << ", box " << i;
          ASSERT_NEAR(static_cast<double>(found->second), static_cast<double>(enter), static_cast<double>(rounding));
        }
        ASSERT_FALSE(enter > leave + rounding && found != is.end()) << "ray " << ray << ", box " << i;
      }
      hits += is.size();
      std::size_t calls = 0;
      manager.rayCast(from, to, [&](Object<S>*, S) { return ++calls == 1; });
      ASSERT_EQ(calls, std::min<std::size_t>(1, is.size()));
    }
    EXPECT_GT(hits, 50U);
  }
}

TYPED_TEST(Extensions, StaleBoxesAreFound) {
  using S = TypeParam;
  using Stale = typename Manager<S>::Stale;
  const auto geometry = std::make_shared<::fcl::Box<S>>(S(1), S(2), S(3));
  std::vector<std::unique_ptr<Object<S>>> objects;
  Manager<S> manager;
  for (int i = 0; i < 4; ++i) {
    objects.push_back(std::make_unique<Object<S>>(geometry));
    objects.back()->computeAABB();
    manager.registerObject(objects.back().get());
  }
  std::vector<std::pair<const Object<S>*, Stale>> found;
  const auto collect = [&](const Object<S>* object, Stale stale) { found.push_back({object, stale}); };
  EXPECT_EQ(manager.findStale(collect), 0U);
  objects[1]->setTranslation(::fcl::Vector3<S>(1, 0, 0));
  objects[3]->setTranslation(::fcl::Vector3<S>(1, 0, 0));
  objects[3]->computeAABB();
  EXPECT_EQ(manager.findStale(collect), 2U);
  EXPECT_EQ(found, (std::vector<std::pair<const Object<S>*, Stale>>{{objects[1].get(), Stale::not_computed},
                                                                    {objects[3].get(), Stale::not_updated}}));
  manager.setStaleWarning(true);
  std::size_t calls = 0;
  const auto count = [](Object<S>*, Object<S>*, void* data) {
    ++*static_cast<std::size_t*>(data);
    return false;
  };
  ::testing::internal::CaptureStderr();
  manager.collide(&calls, count);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(),
            "boxstream::fcl: 2 of 4 boxes are stale: 1 wait for computeAABB(), 1 for the manager's update\n");
  EXPECT_EQ(calls, 6U);

  // Each kind of query warns.
  Manager<S> other;
  Object<S> alone(geometry);
  alone.computeAABB();
  other.registerObject(&alone);
  const auto farther = [](Object<S>*, Object<S>*, void*, S&) { return false; };
  const std::vector<std::function<void()>> queries{[&] { manager.collide(objects[0].get(), &calls, count); },
                                                   [&] { manager.collide(&other, &calls, count); },
                                                   [&] { manager.distance(&calls, farther); },
                                                   [&] { manager.distance(objects[0].get(), &calls, farther); },
                                                   [&] { manager.distance(&other, &calls, farther); },
                                                   [&] {
                                                     manager.rayCast(::fcl::Vector3<S>(0, 0, 0),
                                                                     ::fcl::Vector3<S>(1, 0, 0),
                                                                     [](const Object<S>*, S) { return false; });
                                                   }};
  for (const auto& query : queries) {
    ::testing::internal::CaptureStderr();
    query();
    EXPECT_NE(::testing::internal::GetCapturedStderr().find("2 of 4 boxes are stale"), std::string::npos);
  }
  objects[1]->computeAABB();
  manager.update();
  ::testing::internal::CaptureStderr();
  manager.collide(&calls, count);
  manager.collide(objects[0].get(), &calls, count);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  found.clear();
  // A box that is larger than it need be is no mistake.
  BoxObject<S> inflated(cube<S>(0, 0, 0, 7));
  manager.registerObject(&inflated);
  EXPECT_EQ(manager.findStale(collect), 0U);
}

}  // namespace
}  // namespace boxstream::fcl_test
