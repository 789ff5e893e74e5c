// SPDX-License-Identifier: MIT
// What users of FCL's managers rely on, and those of its successor Coal: once for both. An Engine has the types Scalar,
// Object, Base (the engine's manager), Manager (ours) and Foreign (one of the engine's own); object() makes an object,
// set(object, lo, hi) gives it a box, and collide(manager, on_pair, of...) and distance(manager, on_pair, of...) ask
// about nothing more, an object, or another manager.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace boxstream::managers_test {

template <class Engine>
struct Contract : ::testing::Test {
  using S = typename Engine::Scalar;
  using Object = typename Engine::Object;
  using Base = typename Engine::Base;
  using Manager = typename Engine::Manager;
  using Objects = std::vector<Object*>;
  using Pairs = std::set<std::pair<Object*, Object*>>;
  struct Box {
    std::array<S, 3> lo, hi;
  };
  static constexpr S inf = std::numeric_limits<S>::infinity();
  static constexpr S nan = std::numeric_limits<S>::quiet_NaN();

  static Box box_of(const Object* object) {
    Box box;
    for (int d = 0; d < 3; ++d) {
      box.lo[std::size_t(d)] = object->getAABB().min_[d];
      box.hi[std::size_t(d)] = object->getAABB().max_[d];
    }
    return box;
  }
  static bool touch(const Object* one, const Object* other) {
    const Box a = box_of(one), b = box_of(other);
    for (std::size_t d = 0; d < 3; ++d)
      if (a.lo[d] > b.hi[d] || b.lo[d] > a.hi[d]) return false;
    return true;
  }
  static S apart(const Object* one, const Object* other) {
    const Box a = box_of(one), b = box_of(other);
    S sum = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      const S gap = std::max({S(0), a.lo[d] - b.hi[d], b.lo[d] - a.hi[d]});
      sum += gap * gap;
    }
    return std::sqrt(sum);
  }
  static Box cube(S at, S side = 1) { return {{at, at, at}, {at + side, at + side, at + side}}; }

  /// Objects at random places.
  class Crowd {
   public:
    explicit Crowd(std::size_t size, unsigned seed = 5, S side = 12) : random_(seed), side_(side) {
      for (std::size_t i = 0; i < size; ++i) add({});
      move();
    }
    explicit Crowd(const std::vector<Box>& boxes) {
      for (const Box& box : boxes) add(box);
    }
    void move() {
      std::uniform_real_distribution<S> in(0, side_);
      for (Object* const each : objects) {
        Box box;
        for (std::size_t d = 0; d < 3; ++d) {
          box.lo[d] = in(random_);
          box.hi[d] = box.lo[d] + in(random_) / 4;
        }
        Engine::set(*each, box.lo, box.hi);
      }
    }
    void free_all() { owned_.clear(); }
    Object& operator[](std::size_t i) { return *objects[i]; }

    Objects objects;

   private:
    void add(const Box& box) {
      owned_.push_back(Engine::object());
      objects.push_back(owned_.back().get());
      Engine::set(*objects.back(), box.lo, box.hi);
    }

    std::mt19937 random_;
    S side_ = 0;
    std::vector<std::unique_ptr<Object>> owned_;
  };

  static Pairs all_pairs(const Objects& a, const Objects& b) {
    Pairs pairs;
    for (Object* const one : a)
      for (Object* const other : b)
        if (one != other && touch(one, other)) pairs.emplace(std::minmax(one, other));
    return pairs;
  }
  static Pairs all_pairs(const Objects& all) { return all_pairs(all, all); }
  static S least_of(const Objects& a, const Objects& b) {
    S least = inf;
    for (Object* const one : a)
      for (Object* const other : b)
        if (one != other) least = std::min(least, apart(one, other));
    return least;
  }

  static bool is_last(const Object* second, const Object& of) { return second == &of; }
  static bool is_last(const Object* second, const Base& of) {
    Objects objects;
    of.getObjects(objects);
    return std::find(objects.begin(), objects.end(), second) != objects.end();
  }
  template <class... Of>
  static Pairs collide(const Base& manager, Of&... of) {
    Pairs pairs;
    Engine::collide(
        manager,
        [&](Object* a, Object* b) {
          EXPECT_NE(a, b);
          EXPECT_TRUE((is_last(b, of) && ...)) << "the one that is asked about comes second";
          EXPECT_TRUE(pairs.emplace(std::minmax(a, b)).second) << "a pair twice";
          return false;
        },
        of...);
    return pairs;
  }
  struct Near {
    S least = inf;
    int calls = 0;
  };
  /// What callbacks find that lower the limit to the least distance so far.
  template <class... Of>
  static Near nearest(const Base& manager, Of&... of) {
    Near near;
    Engine::distance(
        manager,
        [&](Object* a, Object* b, S& limit) {
          ++near.calls;
          EXPECT_NE(a, b);
          limit = near.least = std::min(near.least, apart(a, b));
          return false;
        },
        of...);
    return near;
  }
  /// How many calls there are of a callback that returns true, or throws, at call `last`.
  template <class... Of>
  static int calls_until(int last, bool throws, const Base& manager, Of&... of) {
    int calls = 0;
    auto on_pair = [&](Object*, Object*) {
      if (++calls == last && throws) throw std::logic_error("narrow phase");
      return calls == last;
    };
    try {
      Engine::collide(manager, on_pair, of...);
    } catch (const std::logic_error&) {
      EXPECT_TRUE(throws);
    }
    return calls;
  }
  template <class... Of>
  static int distances_until(int last, const Base& manager, Of&... of) {
    int calls = 0;
    Engine::distance(
        manager, [&](Object*, Object*, S&) { return ++calls == last; }, of...);
    return calls;
  }

  static void expect_truth(const Manager& manager, Manager& others, const Objects& mine, const Objects& theirs) {
    EXPECT_EQ(collide(manager), all_pairs(mine));
    EXPECT_EQ(collide(manager, others), all_pairs(mine, theirs));
    EXPECT_EQ(nearest(manager).least, least_of(mine, mine));
    EXPECT_EQ(nearest(manager, others).least, least_of(mine, theirs));
    for (Object* const query : {mine.front(), theirs.front(), theirs.back()}) {
      EXPECT_EQ(collide(manager, *query), all_pairs(mine, {query}));
      EXPECT_EQ(nearest(manager, *query).least, least_of(mine, {query}));
    }
  }
};
TYPED_TEST_SUITE_P(Contract);

TYPED_TEST_P(Contract, EveryQueryEqualsAllPairsOfBoxes) {
  using T = TestFixture;
  for (const std::size_t size : {2U, 9U, 150U, 700U}) {
    typename T::Crowd crowd(size), others(size / 2 + 1, 6);
    typename T::Manager manager, manager_of_others;
    manager.registerObjects(crowd.objects);
    manager_of_others.registerObjects(others.objects);
    for (int round = 0; round < 3; ++round) {
      T::expect_truth(manager, manager_of_others, crowd.objects, others.objects);
      crowd.move();
      manager.update();
    }
  }
}

TYPED_TEST_P(Contract, BoxesAreReadByUpdatesAlone) {
  using T = TestFixture;
  typename T::Crowd crowd(40, 7, 4);
  typename T::Manager manager;
  manager.registerObjects(crowd.objects);
  const auto before = T::all_pairs(crowd.objects);
  crowd.move();
  EXPECT_EQ(T::collide(manager), before);
  manager.update(crowd.objects.front());
  manager.update(typename T::Objects(crowd.objects.begin() + 1, crowd.objects.end()));
  EXPECT_EQ(T::collide(manager), T::all_pairs(crowd.objects));
  EXPECT_NE(T::collide(manager), before);
}

TYPED_TEST_P(Contract, ObjectsComeAndGo) {
  using T = TestFixture;
  typename T::Crowd crowd(30, 8, 4);
  typename T::Manager manager;
  EXPECT_TRUE(manager.empty());
  manager.registerObjects(crowd.objects);
  manager.registerObject(crowd.objects[3]);  // again: its box is read
  EXPECT_EQ(manager.size(), 30U);
  typename T::Objects objects(3);  // what was there goes
  manager.getObjects(objects);
  EXPECT_EQ(objects, crowd.objects);
  manager.unregisterObject(crowd.objects[3]);
  manager.unregisterObject(crowd.objects[3]);
  crowd.objects.erase(crowd.objects.begin() + 3);
  manager.getObjects(objects);
  EXPECT_EQ(objects, crowd.objects);
  EXPECT_EQ(T::collide(manager), T::all_pairs(crowd.objects));
  manager.clear();
  EXPECT_TRUE(manager.empty());
  EXPECT_TRUE(T::collide(manager).empty());
  EXPECT_TRUE(T::collide(manager, crowd[0]).empty());
  EXPECT_EQ(T::nearest(manager).calls + T::nearest(manager, crowd[0]).calls, 0);
}

TYPED_TEST_P(Contract, ObjectsMayBeGoneFirst) {
  using T = TestFixture;
  typename T::Crowd gone(200), rest(200, 6);
  typename T::Manager manager, cleared, destroyed;
  for (auto* const each : {&manager, &cleared, &destroyed}) {
    each->registerObjects(gone.objects);
    EXPECT_FALSE(T::collide(*each).empty());
  }
  manager.registerObjects(rest.objects);
  for (auto* const object : gone.objects) manager.unregisterObject(object);
  gone.free_all();
  for (auto* const object : gone.objects) manager.unregisterObject(object);  // once more, unknown and dead
  EXPECT_EQ(T::collide(manager), T::all_pairs(rest.objects));
  cleared.clear();
  EXPECT_TRUE(T::collide(cleared).empty());
  cleared.registerObjects(rest.objects);
  EXPECT_EQ(T::collide(cleared), T::all_pairs(rest.objects));
}

TYPED_TEST_P(Contract, ACallbackThatReturnsTrueOrThrowsIsTheLast) {
  using T = TestFixture;
  for (const std::size_t size : {40U, 200U}) {
    typename T::Crowd crowd(size, 9, 2), others(size, 10, 2), everywhere({T::cube(-9, 99)});
    typename T::Manager manager, other;
    manager.registerObjects(crowd.objects);
    other.registerObjects(others.objects);
    const auto self = T::collide(manager), between = T::collide(manager, other),
               one = T::collide(manager, everywhere[0]);
    ASSERT_EQ(one.size(), size);
    ASSERT_GT(std::min(self.size(), between.size()), 2U);
    for (const int last : {1, 2, 7, int(size)})
      for (const bool throws : {false, true}) {
        EXPECT_EQ(T::calls_until(last, throws, manager), std::min(last, int(self.size())));
        EXPECT_EQ(T::calls_until(last, throws, manager, other), std::min(last, int(between.size())));
        EXPECT_EQ(T::calls_until(last, throws, manager, everywhere[0]), last);
        EXPECT_EQ(T::collide(manager), self) << "a later query starts afresh";
        EXPECT_EQ(T::collide(manager, everywhere[0]), one);
      }
    EXPECT_EQ(T::distances_until(3, manager), 3);
    EXPECT_EQ(T::distances_until(3, manager, other), 3);
    EXPECT_EQ(T::distances_until(3, manager, everywhere[0]), 3);
  }
}

TYPED_TEST_P(Contract, CallbacksMayQuery) {
  using T = TestFixture;
  typename T::Crowd crowd(80, 10, 6);
  typename T::Manager manager;
  manager.registerObjects(crowd.objects);
  const auto self = T::collide(manager), one = T::collide(manager, crowd[7]);
  const auto least = T::nearest(manager, crowd[7]).least;
  int nested = 0;
  auto look = [&](auto*, auto*, auto&&...) {
    ++nested;
    EXPECT_EQ(T::collide(manager, crowd[7]), one);
    EXPECT_EQ(T::nearest(manager, crowd[7]).least, least);
    EXPECT_TRUE(nested % 16 != 0 || T::collide(manager) == self);
    return false;
  };
  TypeParam::collide(manager, look);
  EXPECT_EQ(nested, int(self.size()));
  TypeParam::collide(manager, look, crowd[7]);
  EXPECT_EQ(nested, int(self.size() + one.size()));
  TypeParam::distance(manager, look, crowd[7]);
  EXPECT_EQ(nested, int(self.size() + one.size()) + 79);
}

TYPED_TEST_P(Contract, BoundsOfAnyKind) {
  using T = TestFixture;
  constexpr auto no = T::nan, far = T::inf;
  typename T::Crowd crowd({T::cube(0),
                           {{no, 0, 0}, {1, 1, 1}},               // a bound that is no number is none
                           {{7, 0, 0}, {1, 1, 1}},                // inside out: nowhere
                           {{1, 0, 0}, {1, 1, 1}},                // flat, and it touches
                           {{-far, -far, -far}, {far, far, -5}},  // half of space, which only what has no bound reaches
                           {{1, 1, 1}, {1, 1, 1}}});
  typename T::Manager manager;
  manager.registerObjects(crowd.objects);
  manager.update();
  const auto pair = [&](std::size_t a, std::size_t b) { return std::minmax(crowd.objects[a], crowd.objects[b]); };
  EXPECT_EQ(T::collide(manager),
            (typename T::Pairs{pair(0, 1), pair(0, 3), pair(0, 5), pair(1, 3), pair(1, 5), pair(3, 5)}));
  EXPECT_TRUE(T::collide(manager, crowd[2]).empty());
  EXPECT_EQ(T::collide(manager, crowd[3]).size(), 3U);
  EXPECT_TRUE(T::collide(manager, crowd[4]).empty());
}

TYPED_TEST_P(Contract, AnyManagerAsTheOther) {
  using T = TestFixture;
  struct Derived : T::Manager {};
  for (const auto& [ours, theirs] : {std::pair{12U, 9U}, {400U, 9U}, {9U, 400U}, {400U, 300U}}) {
    typename T::Crowd mine(ours), others(theirs, 6);
    others.objects.push_back(mine.objects[1]);  // in both: it does not meet itself
    typename T::Manager manager, same;
    Derived derived;
    typename TypeParam::Foreign foreign;
    manager.registerObjects(mine.objects);
    for (typename T::Base* const other : std::initializer_list<typename T::Base*>{&same, &derived, &foreign})
      for (auto* const object : others.objects) other->registerObject(object);
    const auto pairs = T::all_pairs(mine.objects, others.objects);
    const auto least = T::least_of(mine.objects, others.objects);
    for (typename T::Base* const other : std::initializer_list<typename T::Base*>{&same, &derived, &foreign}) {
      EXPECT_EQ(T::collide(manager, *other), pairs);
      EXPECT_EQ(T::nearest(manager, *other).least, least);
      EXPECT_EQ(other->size(), others.objects.size());
    }
    EXPECT_EQ(T::collide(derived, manager), pairs);
    EXPECT_EQ(T::collide(manager, static_cast<typename T::Base&>(manager)), T::all_pairs(mine.objects));
    EXPECT_EQ(T::nearest(manager, static_cast<typename T::Base&>(manager)).least,
              T::least_of(mine.objects, mine.objects));
    // Of ours the boxes that it has read, in any class; of others those that their objects have.
    others.move();
    EXPECT_EQ(T::collide(manager, same), pairs);
    EXPECT_EQ(T::collide(manager, derived), pairs);
  }
}

TYPED_TEST_P(Contract, AManagedQueryObjectDoesNotMeetItself) {
  using T = TestFixture;
  typename T::Crowd crowd({T::cube(0), T::cube(0), T::cube(0)});
  typename T::Manager manager;
  manager.registerObjects(crowd.objects);
  EXPECT_EQ(T::calls_until(9, false, manager, crowd[1]), 2);
  EXPECT_EQ(T::distances_until(9, manager, crowd[1]), 2);
}

TYPED_TEST_P(Contract, NearPairsEndTheSearchEarly) {
  using T = TestFixture;
  typename T::Crowd crowd(2000, 11, 100);
  typename T::Manager manager;
  manager.registerObjects(crowd.objects);
  EXPECT_LT(T::nearest(manager, crowd[0]).calls, 200);
}

TYPED_TEST_P(Contract, ALimitOfZeroOrLessOrNoNumberEndsADistanceQuery) {
  using T = TestFixture;
  using Scalar = typename TypeParam::Scalar;
  typename T::Crowd crowd(100), others(30, 6);
  typename T::Manager manager, other;
  manager.registerObjects(crowd.objects);
  other.registerObjects(others.objects);
  const auto calls_with = [&](Scalar limit, auto&... of) {
    int calls = 0;
    TypeParam::distance(
        manager, [&](auto*, auto*, Scalar& least) { return ++calls, least = limit, false; }, of...);
    return calls;
  };
  for (const Scalar limit : {Scalar(0), Scalar(-1), T::nan, -T::inf}) {
    EXPECT_EQ(calls_with(limit), 1) << limit;
    EXPECT_EQ(calls_with(limit, crowd[50]), 1) << limit;
    EXPECT_EQ(calls_with(limit, other), 1) << limit;
  }
  EXPECT_EQ(calls_with(T::inf), 100 * 99 / 2);
  EXPECT_EQ(calls_with(T::inf, crowd[50]), 99);
  EXPECT_EQ(calls_with(T::inf, other), 3000);
}

REGISTER_TYPED_TEST_SUITE_P(Contract, EveryQueryEqualsAllPairsOfBoxes, BoxesAreReadByUpdatesAlone, ObjectsComeAndGo,
                            ObjectsMayBeGoneFirst, ACallbackThatReturnsTrueOrThrowsIsTheLast, CallbacksMayQuery,
                            BoundsOfAnyKind, AnyManagerAsTheOther, AManagedQueryObjectDoesNotMeetItself,
                            NearPairsEndTheSearchEarly, ALimitOfZeroOrLessOrNoNumberEndsADistanceQuery);

}  // namespace boxstream::managers_test
