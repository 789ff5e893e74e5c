// SPDX-License-Identifier: MIT
// C12: `dist` is in and out, may hold anything, and every query ends.
#include <cmath>

#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

template <class S>
struct Distance : ::testing::Test {};
TYPED_TEST_SUITE(Distance, Scalars);

template <class S>
long double distance_of(const FclBox<S>& a, const FclBox<S>& b) {
  long double sum = 0;
  for (int d = 0; d < 3; ++d) {
    const long double gap = std::max(
        {static_cast<long double>(a.min_[d]) - b.max_[d], static_cast<long double>(b.min_[d]) - a.max_[d], 0.0L});
    sum += gap * gap;
  }
  return std::sqrt(sum);
}

/// What a callback leaves in `dist`, by the number of the call.
template <class S>
struct Script {
  S (*next)(std::size_t call, S dist, S box_distance);
  Calls calls;
  std::vector<long double> distances;

  static bool run(Object<S>* a, Object<S>* b, void* data, S& dist) {
    Script& script = *static_cast<Script*>(data);
    const long double exact = distance_of(a->getAABB(), b->getAABB());
    record<S>(a, b, &script.calls);
    script.distances.push_back(exact);
    dist = script.next(script.calls.size(), dist, static_cast<S>(exact));
    return false;
  }
};

template <class S>
constexpr long double rounding = sizeof(S) == 4 ? 1e-5L : 1e-13L;

/// Every pair below `limit`, none twice, none far beyond `most`.
template <class S>
void expect_all_below(const Script<S>& script, const Calls& pairs, const std::vector<long double>& distances,
                      long double limit, long double most) {
  const Calls is = sorted(script.calls);
  ASSERT_EQ(std::adjacent_find(is.begin(), is.end()), is.end());
  std::size_t clear = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Calls pair = sorted({pairs[i]});
    const bool found = std::binary_search(is.begin(), is.end(), pair[0]);
    if (distances[i] < limit * (1 - rounding<S>)) {
      ASSERT_TRUE(found) << pairs[i].first << ", " << pairs[i].second;
      ++clear;
    }
    const bool is_beyond = distances[i] > most * (1 + rounding<S>);
    ASSERT_FALSE(found && is_beyond) << pairs[i].first << ", " << pairs[i].second;
  }
  ASSERT_GE(is.size(), clear);
}

/// The three kinds of query, and all the pairs that each is about.
template <class S>
struct Setting {
  explicit Setting(std::size_t size) {
    std::mt19937 random(33);
    for (const FclBox<S>& box : random_cubes<S>(size + size / 4 + 1, 1, random)) {
      if (scene.size() < size)
        scene.add(box);
      else
        others.push_back(std::make_unique<BoxObject<S>>(box, static_cast<int>(size + others.size())));
    }
    manager.registerObjects(scene.pointers());
    for (const auto& object : others) other.registerObject(object.get());
    for (std::size_t i = 0; i < size; ++i) {
      for (std::size_t j = i + 1; j < size; ++j) add(0, scene[i], scene[j]);
      if (i != size / 2) add(1, scene[i], scene[size / 2]);
      for (const auto& object : others) add(2, scene[i], *object);
    }
  }

  void add(int kind, BoxObject<S>& a, BoxObject<S>& b) {
    pairs[kind].push_back({a.name(), b.name()});
    distances[kind].push_back(distance_of(a.getAABB(), b.getAABB()));
  }

  Script<S> run(int kind, S (*next)(std::size_t, S, S)) {
    Script<S> script{next, {}, {}};
    if (kind == 0) manager.distance(&script, Script<S>::run);
    if (kind == 1) manager.distance(&scene[scene.size() / 2], &script, Script<S>::run);
    if (kind == 2) manager.distance(&other, &script, Script<S>::run);
    return script;
  }

  Scene<S> scene;
  std::vector<std::unique_ptr<BoxObject<S>>> others;
  Manager<S> manager, other;
  Calls pairs[3];
  std::vector<long double> distances[3];
};

TYPED_TEST(Distance, C12_NeverWritten) {
  using S = TypeParam;
  for (const std::size_t size : {3, 40, 300}) {
    Setting<S> s(size);
    for (int kind = 0; kind < 3; ++kind) {
      const Script<S> script = s.run(kind, [](std::size_t, S dist, S) { return dist; });
      EXPECT_EQ(script.calls.size(), s.pairs[kind].size());
      constexpr auto all = std::numeric_limits<long double>::infinity();
      expect_all_below<S>(script, s.pairs[kind], s.distances[kind], all, all);
    }
  }
}

TYPED_TEST(Distance, C12_AConstantRadius) {
  using S = TypeParam;
  for (const std::size_t size : {40, 300}) {
    Setting<S> s(size);
    for (int kind = 0; kind < 3; ++kind) {
      // The first call is made without any.
      const Script<S> script = s.run(kind, [](std::size_t, S, S) { return S(0.75); });
      const long double first = std::max(0.75L, script.distances[0]);
      expect_all_below<S>(script, s.pairs[kind], s.distances[kind], 0.75L, first);
      for (std::size_t i = 1; i < script.distances.size(); ++i)
        ASSERT_LE(script.distances[i], 0.75L * (1 + rounding<S>)) << "call " << i;
    }
  }
}

TYPED_TEST(Distance, C12_TheNearestPairInAFewCalls) {
  using S = TypeParam;
  // Cubes so far apart that none touch; the distance of the boxes is taken for that of the shapes.
  std::mt19937 random(4);
  std::vector<FclBox<S>> boxes;
  std::uniform_real_distribution<double> off(0, 0.4);
  for (int i = 0; i < 400; ++i)
    boxes.push_back(cube<S>(static_cast<S>(2 * (i % 8) + off(random)), static_cast<S>(2 * (i / 8 % 8) + off(random)),
                            static_cast<S>(2 * (i / 64) + off(random))));
  Scene<S> scene(boxes);
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  Script<S> script{[](std::size_t, S, S box_distance) { return box_distance; }, {}, {}};
  manager.distance(&script, Script<S>::run);
  long double nearest = 1e30L;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j) nearest = std::min(nearest, distance_of(boxes[i], boxes[j]));
  ASSERT_LE(script.calls.size(), 6U);
  EXPECT_LE(*std::min_element(script.distances.begin(), script.distances.end()), nearest * (1 + rounding<S>));
}

/// What was left out may stay out.
TYPED_TEST(Distance, C12_Raised) {
  using S = TypeParam;
  Setting<S> s(120);
  for (int kind = 0; kind < 3; ++kind) {
    ASSERT_GE(std::count(s.distances[kind].begin(), s.distances[kind].end(), 0.0L), kind == 1 ? 0 : 6);
    const Script<S> script = s.run(kind, [](std::size_t call, S, S) { return call < 6 ? S(0.3) : S(1.25); });
    if (script.calls.size() < 6) continue;
    const long double most = std::max(1.25L, script.distances[0]);
    expect_all_below<S>(script, s.pairs[kind], s.distances[kind], 0.3L, most);
  }
  const Script<S> script = s.run(0, [](std::size_t call, S, S) { return call < 6 ? S(0.3) : S(1.25); });
  EXPECT_GT(script.calls.size(), 6U);
}

TYPED_TEST(Distance, C12_OverlappingBoxesAreAtZero) {
  using S = TypeParam;
  Scene<S> scene(std::vector<FclBox<S>>(8, cube<S>(0, 0, 0)));
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  Script<S> script{[](std::size_t, S, S) { return S(1e-6); }, {}, {}};  // as Drake keeps it above zero
  manager.distance(&script, Script<S>::run);
  EXPECT_CALLS(sorted(script.calls), sorted(collide<S>(manager)));
}

TYPED_TEST(Distance, TheOrderIsThatOfTheSameHistory) {
  using S = TypeParam;
  Calls calls[2];
  for (Calls& all : calls) {
    Setting<S> s(150);
    for (std::size_t i = 0; i < s.scene.size(); i += 2) s.manager.unregisterObject(&s.scene[i]);
    s.manager.distance(&all, record_distance<S>);
    s.manager.registerObjects(s.scene.pointers());
    for (int i = 0; i < 5; ++i) s.manager.update();
    s.manager.distance(&all, record_distance<S>);
  }
  EXPECT_CALLS(calls[1], calls[0]);
}

TYPED_TEST(Distance, C11_UnboundedBoxesAndNan) {
  using S = TypeParam;
  FclBox<S> sick;
  sick.min_.setConstant(nan<S>);
  sick.max_.setConstant(nan<S>);
  Scene<S> scene({make_box<S>(-inf<S>, -inf<S>, -inf<S>, inf<S>, inf<S>, 0), cube<S>(0, 0, 2), cube<S>(5, 0, 4),
                  FclBox<S>(), sick, make_box<S>(5, 5, 5, 4, 6, 6)});
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  Calls calls;
  manager.distance(&calls, record_distance<S>);
  // Those that are inside out are nowhere; NaN is everywhere.
  EXPECT_CALLS(sorted(calls), (Calls{{0, 1}, {0, 2}, {0, 4}, {1, 2}, {1, 4}, {2, 4}}));
}

/// Many that came after the index was made, so that there are many ways into it: none is gone once the query has ended.
TYPED_TEST(Distance, C10_NothingIsVisitedAfterTheEnd) {
  using S = TypeParam;
  const auto place = [](int i) { return cube<S>(S(2 * (i % 100)), S(2 * (i / 100)), 0, S(0.5)); };
  Scene<S> scene;
  Manager<S> manager, other;
  for (int i = 0; i < 10000; ++i) manager.registerObject(&scene.add(place(i)));
  for (int i = 10000; i < 13000; ++i) other.registerObject(&scene.add(place(i)));
  int calls = 0;
  const auto stop = [](Object<S>*, Object<S>*, void* count, S&) { return ++*static_cast<int*>(count) > 0; };
  manager.distance(&scene[0], &calls, stop);
  other.distance(&scene[10000], &calls, stop);
  for (int i = 13000; i < 13400; ++i) manager.registerObject(&scene.add(place(i)));
  for (int i = 13400; i < 13650; ++i) other.registerObject(&scene.add(place(i)));
  for (const bool at_once : {true, false}) {
    calls = 0;
    manager.distance(&calls, stop);
    EXPECT_EQ(calls, 1);
    manager.distance(&other, &calls, stop);
    EXPECT_EQ(calls, 2);
    if (!at_once) continue;
    // And where the callback ends it by its limit.
    const auto touch = [](Object<S>*, Object<S>*, void* count, S& limit) {
      ++*static_cast<int*>(count);
      limit = 0;
      return false;
    };
    manager.distance(&calls, touch);
    manager.distance(&other, &calls, touch);
    EXPECT_EQ(calls, 4);
  }
}

}  // namespace
}  // namespace boxstream::fcl_test
