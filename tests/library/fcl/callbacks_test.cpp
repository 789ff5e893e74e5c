// SPDX-License-Identifier: MIT
// What callbacks may do: stop, throw, query the manager again.
#include <stdexcept>

#include <algorithm>
#include "sanitized.hpp"

#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

template <class S>
struct Callbacks : ::testing::Test {};
TYPED_TEST_SUITE(Callbacks, Scalars);

struct Countdown {
  std::size_t calls_left;
  Calls calls;
};

template <class S>
bool stop_later(Object<S>* a, Object<S>* b, void* data) {
  Countdown& countdown = *static_cast<Countdown*>(data);
  record<S>(a, b, &countdown.calls);
  return --countdown.calls_left == 0;
}
template <class S>
bool throw_later(Object<S>* a, Object<S>* b, void* data) {
  if (stop_later<S>(a, b, data)) throw std::logic_error("narrow phase");
  return false;
}
template <class S>
bool stop_distance_later(Object<S>* a, Object<S>* b, void* data, S&) {
  return stop_later<S>(a, b, data);
}
template <class S>
bool throw_distance_later(Object<S>* a, Object<S>* b, void* data, S&) {
  return throw_later<S>(a, b, data);
}

Calls first_of(const Calls& calls, std::size_t count) {
  return {calls.begin(), calls.begin() + static_cast<std::ptrdiff_t>(count)};
}

/// A manager in the state that a test wants it in: changed a moment ago, or queried before.
enum class Warm { no, yes };

template <class S>
struct Setting {
  explicit Setting(std::size_t size, double pairs = 4) {
    std::mt19937 random(21);
    for (const FclBox<S>& box : random_cubes<S>(size, pairs, random)) scene.add(box);
    for (const FclBox<S>& box : random_cubes<S>(size / 3, pairs / 3, random)) others.add(box);
    other.registerObjects(others.pointers());
    manager.setRegistrationOrder(true);
    fill(manager, Warm::yes);
  }

  void fill(Manager<S>& to, Warm warm) {
    to.clear();
    to.registerObjects(scene.pointers());
    if (warm == Warm::no) return;
    collide<S>(to);
    for (int i = 0; i < 200; ++i) collide<S>(to, scene[0]);
  }

  Scene<S> scene, others;
  Manager<S> manager, other;
};

TYPED_TEST(Callbacks, C7_StopAtEveryCall) {
  using S = TypeParam;
  for (const std::size_t size : {20, 300}) {
    Setting<S> s(size);
    Manager<S>& manager = s.manager;
    const Calls self = collide<S>(manager), cross = collide<S>(manager, s.other);
    BoxObject<S> query(cube<S>(1, 1, 1, S(3)), 1000);
    const Calls one = collide<S>(manager, query);
    ASSERT_GT(self.size(), 20U);
    ASSERT_GT(cross.size(), 5U);
    ASSERT_GT(one.size(), 5U);
    for (const Warm warm : {Warm::no, Warm::yes}) {
      const std::size_t step = size == 20 ? 1 : 23;
      for (std::size_t k = 1; k <= self.size(); k += step) {
        s.fill(manager, warm);
        Countdown countdown{k, {}};
        manager.collide(&countdown, stop_later<S>);
        EXPECT_CALLS(countdown.calls, first_of(self, k));
        EXPECT_CALLS(collide<S>(manager), self);  // a later query starts afresh
      }
      for (std::size_t k = 1; k <= cross.size(); k += step) {
        s.fill(manager, warm);
        Countdown countdown{k, {}};
        manager.collide(&s.other, &countdown, stop_later<S>);
        EXPECT_CALLS(countdown.calls, first_of(cross, k));
      }
      for (std::size_t k = 1; k <= one.size(); ++k) {
        s.fill(manager, warm);
        Countdown countdown{k, {}};
        manager.collide(&query, &countdown, stop_later<S>);
        EXPECT_CALLS(countdown.calls, first_of(one, k));
      }
    }
  }
}

/// Without an order of registration those that come are some of all.
TYPED_TEST(Callbacks, C7_StopAtEveryCallInAnyOrder) {
  using S = TypeParam;
  for (const std::size_t size : {20, 300}) {
    Setting<S> s(size);
    s.manager.setRegistrationOrder(false);
    const Calls cross = collide<S>(s.manager, s.other);
    BoxObject<S> query(cube<S>(1, 1, 1, S(3)), 1000);
    const Calls one = collide<S>(s.manager, query);
    const auto expect_some_of = [](const Calls& all, const Calls& calls, std::size_t k) {
      const Calls some = in_any_order(calls);
      EXPECT_EQ(some.size(), k);
      EXPECT_TRUE(std::includes(all.begin(), all.end(), some.begin(), some.end()));
    };
    for (const Warm warm : {Warm::no, Warm::yes}) {
      for (std::size_t k = 1; k <= cross.size(); k += size == 20 ? 1 : 23) {
        s.fill(s.manager, warm);
        Countdown countdown{k, {}};
        s.manager.collide(&s.other, &countdown, stop_later<S>);
        expect_some_of(cross, countdown.calls, k);
      }
      for (std::size_t k = 1; k <= one.size(); ++k) {
        s.fill(s.manager, warm);
        Countdown countdown{k, {}};
        s.manager.collide(&query, &countdown, stop_later<S>);
        expect_some_of(one, countdown.calls, k);
      }
    }
  }
}

/// Asked again and again, with and without changes in between: an answer that is remembered must not outlive its boxes.
TYPED_TEST(Callbacks, C7_TheFirstPairsAgainAndAgain) {
  using S = TypeParam;
  for (const std::size_t size : {60, 300}) {
    std::mt19937 random(22);
    Scene<S> scene(random_cubes<S>(size, 0.4, random));
    Manager<S> manager;
    Oracle<S> oracle;
    const auto put = [&](std::size_t i) {
      manager.registerObject(&scene[i]);
      oracle.put(scene[i]);
    };
    for (std::size_t i = 0; i < size; ++i) put(i);
    for (int round = 0; round < (tests::sanitized ? 16 : 60); ++round) {
      const Calls all = oracle.collide();
      for (std::size_t ask = 0; ask < 3; ++ask) {
        const std::size_t k = 1 + (static_cast<std::size_t>(round) + ask) % 4;
        Countdown countdown{k, {}};
        manager.collide(&countdown, stop_later<S>);
        EXPECT_CALLS(countdown.calls, first_of(all, std::min(k, all.size()))) << "round " << round;
      }
      // Every other time one of the first pair.
      const bool of_first = round % 8 < 4 && !all.empty();
      BoxObject<S>& object = scene[of_first ? static_cast<std::size_t>(all[0].second) : random() % size];
      switch (round % 4) {
        case 0:
          object.set(random_cubes<S>(1, 8.0 / (20.0 * static_cast<double>(size)), random)[0]);
          manager.update();
          oracle.look();
          break;
        case 1:
          manager.unregisterObject(&object);
          oracle.erase(object);
          break;
        case 2:
          put(random() % size);
          break;
        default:
          manager.setGroups(&object, {1, 1});  // changes nothing but the state
      }
    }
  }
}

TYPED_TEST(Callbacks, C7_StopAtEveryCallOfDistance) {
  using S = TypeParam;
  Setting<S> s(30);
  BoxObject<S> query(cube<S>(1, 1, 1, S(3)), 1000);
  Calls self, cross, one;
  s.manager.distance(&self, record_distance<S>);
  s.manager.distance(&s.other, &cross, record_distance<S>);
  s.manager.distance(&query, &one, record_distance<S>);
  ASSERT_EQ(self.size(), 30U * 29 / 2);
  ASSERT_EQ(cross.size(), 300U);
  ASSERT_EQ(one.size(), 30U);
  for (std::size_t k = 1; k <= self.size(); ++k) {
    Countdown countdown{k, {}};
    s.manager.distance(&countdown, stop_distance_later<S>);
    EXPECT_CALLS(countdown.calls, first_of(self, k));
  }
  for (std::size_t k = 1; k <= cross.size(); ++k) {
    Countdown countdown{k, {}};
    s.manager.distance(&s.other, &countdown, stop_distance_later<S>);
    EXPECT_CALLS(countdown.calls, first_of(cross, k));
  }
  for (std::size_t k = 1; k <= one.size(); ++k) {
    Countdown countdown{k, {}};
    s.manager.distance(&query, &countdown, stop_distance_later<S>);
    EXPECT_CALLS(countdown.calls, first_of(one, k));
  }
}

TYPED_TEST(Callbacks, C8_ThrowAtEveryCallThenGoOn) {
  using S = TypeParam;
  for (const std::size_t size : {20, 300}) {
    Setting<S> s(size);
    Manager<S>& manager = s.manager;
    const Calls self = collide<S>(manager), cross = collide<S>(manager, s.other), one = collide<S>(manager, s.scene[3]);
    Calls far;
    manager.distance(&far, record_distance<S>);
    const std::size_t step = size == 20 ? 1 : 31;
    for (const Warm warm : {Warm::no, Warm::yes})
      for (std::size_t k = 1; k <= self.size(); k += step) {
        s.fill(manager, warm);
        Countdown countdown{k, {}};
        EXPECT_THROW(manager.collide(&countdown, throw_later<S>), std::logic_error);
        EXPECT_CALLS(countdown.calls, first_of(self, k));
        if (k <= one.size()) {
          Countdown other{k, {}};
          EXPECT_THROW(manager.collide(&s.scene[3], &other, throw_later<S>), std::logic_error);
        }
        if (k <= cross.size()) {
          Countdown other{k, {}};
          EXPECT_THROW(manager.collide(&s.other, &other, throw_later<S>), std::logic_error);
        }
        Countdown distant{k, {}};
        EXPECT_THROW(manager.distance(&distant, throw_distance_later<S>), std::logic_error);
        EXPECT_CALLS(distant.calls, first_of(far, k));
        EXPECT_CALLS(collide<S>(manager), self);
        EXPECT_CALLS(collide<S>(manager, s.scene[3]), one);
        EXPECT_CALLS(collide<S>(manager, s.other), cross);
      }
    // And it may change again.
    manager.unregisterObject(&s.scene[0]);
    manager.update();
    manager.registerObject(&s.scene[0]);
    EXPECT_EQ(collide<S>(manager).size(), self.size());
  }
}

/// A callback that runs every kind of query on the manager that calls it.
template <class S>
struct Nest {
  const Manager<S>* manager;
  Manager<S>* other;
  BoxObject<S>* query;
  Calls self, one, cross, far;
  Calls calls;
  int nested = 0;
  int wrong = 0;

  void look() {
    if (calls.size() % 16 != 1) return;
    ++nested;
    Calls distant;
    manager->distance(query, &distant, record_distance<S>);
    wrong += collide<S>(*manager) != self || collide<S>(*manager, *query) != one ||
             collide<S>(*manager, *other) != cross || distant != far;
  }
  static bool on_pair(Object<S>* a, Object<S>* b, void* data) {
    Nest& nest = *static_cast<Nest*>(data);
    record<S>(a, b, &nest.calls);
    nest.look();
    return false;
  }
  static bool on_distance(Object<S>* a, Object<S>* b, void* data, S&) { return on_pair(a, b, data); }
};

TYPED_TEST(Callbacks, C9_QueriesWithinQueries) {
  using S = TypeParam;
  for (const std::size_t size : {25, 200})
    for (const Warm warm : {Warm::no, Warm::yes})
      for (int kind = 0; kind < 5; ++kind) {
        Setting<S> s(size);
        s.manager.setRegistrationOrder(false);
        Nest<S> nest{&s.manager, &s.other, &s.scene[7], {}, {}, {}, {}, {}, 0, 0};
        nest.self = collide<S>(s.manager);
        nest.one = collide<S>(s.manager, s.scene[7]);
        nest.cross = collide<S>(s.manager, s.other);
        s.manager.distance(&s.scene[7], &nest.far, record_distance<S>);
        Calls all;
        s.manager.distance(&all, record_distance<S>);
        s.fill(s.manager, warm);
        const Manager<S>& manager = s.manager;
        if (kind == 0) manager.collide(&nest, Nest<S>::on_pair);
        if (kind == 1) manager.collide(&s.scene[7], &nest, Nest<S>::on_pair);
        if (kind == 2) manager.collide(&s.other, &nest, Nest<S>::on_pair);
        if (kind == 3) manager.distance(&s.scene[7], &nest, Nest<S>::on_distance);
        if (kind == 4 && size == 25) manager.distance(&nest, Nest<S>::on_distance);
        std::sort(all.begin(), all.end());
        const Calls expected[] = {nest.self, nest.one, nest.cross, nest.far, size == 25 ? all : Calls()};
        if (kind == 1 || kind == 2 || kind == 4) std::sort(nest.calls.begin(), nest.calls.end());
        EXPECT_CALLS(nest.calls, expected[kind]);
        EXPECT_EQ(nest.wrong, 0) << "query of kind " << kind;
        EXPECT_EQ(nest.nested > 0, !expected[kind].empty());
      }
}

}  // namespace
}  // namespace boxstream::fcl_test
