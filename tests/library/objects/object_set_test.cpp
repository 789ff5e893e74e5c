// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boxstream/object_set.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "core/oracle.hpp"
#include "nearest/nearest_distance.hpp"
#include "nearest/nearest_walk.hpp"
#include "sanitized.hpp"

namespace boxstream {
namespace {

template <class S>
constexpr S inf = std::numeric_limits<S>::infinity();

template <class S>
BasicAabb<S> random_box(std::mt19937& random, double room) {
  std::uniform_real_distribution<double> at(0, room), side(0, 1);
  BasicAabb<S> box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = static_cast<S>(at(random));
    box.max[d] = box.min[d] + static_cast<S>(side(random));
  }
  const auto rare = random() % 200;
  if (rare == 0) box.max[1] = inf<S>;
  if (rare == 1) std::swap(box.min[0], box.max[0]);
  if (rare == 2) box.min[2] = std::numeric_limits<S>::quiet_NaN();
  if (rare == 3) box = {{-inf<S>, -inf<S>, -inf<S>}, {inf<S>, inf<S>, inf<S>}};
  return box;
}

/// A set, and the same without any cleverness. Objects are the addresses of their numbers.
template <class S>
struct Twins {
  using Set = BasicObjectSet<S>;
  using Place = typename Set::Place;
  using Pairs = std::vector<std::pair<Place, Place>>;

  Set set;
  std::vector<std::unique_ptr<int>> objects;

  void add(const BasicAabb<S>& box, Filter filter = {}) {
    objects.push_back(std::make_unique<int>(0));
    set.add(objects.back().get(), box, filter, false);
  }

  const auto& table() const { return set.table(); }
  bool touch(Place a, const BasicAabb<S>& box, Filter filter) const {
    return tests::makes_sense(table().box(a)) && tests::makes_sense(box) && tests::touch(table().box(a), box) &&
           tests::permit(table().filter(a), filter);
  }

  std::vector<Place> all_overlaps(const BasicAabb<S>& box, Filter filter) const {
    std::vector<Place> places;
    for (Place i = 0; i < table().places(); ++i)
      if (touch(i, box, filter)) places.push_back(i);
    return places;
  }
  Pairs all_pairs(const Twins& other) const {
    Pairs pairs;
    for (Place i = 0; i < table().places(); ++i)
      for (Place j = &other == this ? i + 1 : 0; j < other.table().places(); ++j)
        if (touch(i, other.table().box(j), other.table().filter(j))) pairs.push_back({i, j});
    return pairs;
  }
  Pairs all_near_pairs(const Twins& other, S limit) const {
    Pairs pairs;
    for (Place i = 0; i < table().places(); ++i)
      for (Place j = &other == this ? i + 1 : 0; j < other.table().places(); ++j) {
        const auto &a = table().box(i), &b = other.table().box(j);
        if (tests::makes_sense(a) && tests::makes_sense(b) &&
            tests::permit(table().filter(i), other.table().filter(j)) && detail::distance_below(a, b) < limit)
          pairs.push_back({i, j});
      }
    return pairs;
  }
};

template <class T>
T sorted(T list) {
  std::sort(list.begin(), list.end());
  return list;
}

template <class S>
void expect_same_overlaps(const Twins<S>& twins, const BasicAabb<S>& box, Filter filter) {
  using Set = BasicObjectSet<S>;
  const auto expected = twins.all_overlaps(box, filter);
  for (const auto order : {Set::Order::any, Set::Order::places}) {
    std::vector<std::uint32_t> found;
    twins.set.for_each_overlap(box, filter, order, [&](std::uint32_t place) {
      found.push_back(place);
      return true;
    });
    ASSERT_EQ(order == Set::Order::any ? sorted(found) : found, expected);
    if (expected.size() < 2) continue;
    std::size_t visits = 0;
    twins.set.for_each_overlap(box, filter, order, [&](std::uint32_t) { return ++visits < 2; });
    ASSERT_EQ(visits, 2u);
  }
  if (twins.set.is_clear(box)) {
    ASSERT_TRUE(expected.empty());
  }
}

template <class S>
void expect_same_pairs(const Twins<S>& twins, const Twins<S>& other) {
  using Set = BasicObjectSet<S>;
  typename Twins<S>::Pairs self;
  const auto add_to = [](auto& pairs) {
    return [&pairs](std::uint32_t a, std::uint32_t b) {
      pairs.push_back({a, b});
      return true;
    };
  };
  twins.set.for_each_pair(add_to(self));
  ASSERT_EQ(self, twins.all_pairs(twins));
  for (const auto order : {Set::Order::any, Set::Order::places}) {
    typename Twins<S>::Pairs cross;
    twins.set.for_each_pair(other.set, order, add_to(cross));
    ASSERT_EQ(order == Set::Order::any ? sorted(cross) : cross, twins.all_pairs(other));
  }
}

template <class S>
void expect_same_distances(const Twins<S>& twins, const Twins<S>& other) {
  for (const S limit : {S(0.3), S(1e-30), S(2)}) {
    typename Twins<S>::Pairs self, cross;
    twins.set.for_each_near_pair(limit, [&](std::uint32_t a, std::uint32_t b) {
      self.push_back({a, b});
      return limit;
    });
    ASSERT_EQ(sorted(self), twins.all_near_pairs(twins, limit));
    twins.set.for_each_near_pair(other.set, limit, [&](std::uint32_t a, std::uint32_t b) {
      cross.push_back({a, b});
      return limit;
    });
    ASSERT_EQ(sorted(cross), twins.all_near_pairs(other, limit));
  }
}

/// Without a limit all pairs come, each once. They begin as the same query without an end does.
template <class S>
void expect_same_without_limit(const Twins<S>& twins, const Twins<S>& other) {
  using Pairs = typename Twins<S>::Pairs;
  const auto visit_all = [&](auto&& visit) {
    &other == &twins ? twins.set.for_each_near_pair(inf<S>, visit)
                     : twins.set.for_each_near_pair(other.set, inf<S>, visit);
  };
  Pairs first_of_all;
  for (int time = 0; time < 2; ++time) {
    Pairs all, until_first;
    visit_all([&](std::uint32_t a, std::uint32_t b) {
      all.push_back({a, b});
      return inf<S>;
    });
    ASSERT_EQ(sorted(all), twins.all_near_pairs(other, inf<S>));
    visit_all([&](std::uint32_t a, std::uint32_t b) {
      until_first.push_back({a, b});
      return S(0);
    });
    ASSERT_EQ(until_first.size(), std::min<std::size_t>(all.size(), 1));
    // Of very few it is known from the beginning only if it touches, or there is no other.
    if (all.empty() || twins.table().size() * other.table().size() <= 16) continue;
    ASSERT_EQ(all[0], until_first[0]);
    if (first_of_all.empty()) first_of_all.push_back(all[0]);
    ASSERT_EQ(all[0], first_of_all[0]);
  }
}

/// By a limit that shrinks the least distance of a pair is found.
template <class S>
void expect_least_distance(const Twins<S>& twins, const Twins<S>& other) {
  S least = inf<S>, expected = inf<S>;
  for (const auto& [a, b] : twins.all_near_pairs(other, inf<S>))
    expected = std::min(expected, detail::distance_below(twins.table().box(a), other.table().box(b)));
  const auto nearer = [&](std::uint32_t a, std::uint32_t b) {
    least = std::min(least, detail::distance_below(twins.table().box(a), other.table().box(b)));
    return least;
  };
  &other == &twins ? twins.set.for_each_near_pair(inf<S>, nearer)
                   : twins.set.for_each_near_pair(other.set, inf<S>, nearer);
  ASSERT_EQ(least, expected);
}

template <class S>
void expect_same_beginnings(const Twins<S>& twins, const Twins<S>& other) {
  for (const Twins<S>* of : {&twins, &other}) {
    ASSERT_NO_FATAL_FAILURE(expect_least_distance(twins, *of));
    ASSERT_NO_FATAL_FAILURE(expect_same_without_limit(twins, *of));
    ASSERT_NO_FATAL_FAILURE(expect_least_distance(twins, *of));
  }
}

/// By a limit that shrinks the least distance is found.
template <class S>
void expect_least_distance(const Twins<S>& twins, const BasicAabb<S>& box, Filter filter) {
  S least = inf<S>, expected = inf<S>;
  for (std::uint32_t i = 0; i < twins.table().places(); ++i)
    if (tests::makes_sense(box) && tests::makes_sense(twins.table().box(i)) &&
        tests::permit(filter, twins.table().filter(i)))
      expected = std::min(expected, detail::distance_below(twins.table().box(i), box));
  twins.set.for_each_near(box, filter, inf<S>, [&](std::uint32_t place) {
    least = std::min(least, detail::distance_below(twins.table().box(place), box));
    return least;
  });
  ASSERT_EQ(least, expected);
}

template <class S>
class ObjectSets : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ObjectSets, Scalars);

TYPED_TEST(ObjectSets, AnyHistoryIsWhatBruteForceSays) {
  using S = TypeParam;
  for (const auto& [size, steps] : {std::pair(6, 60), std::pair(60, 40), std::pair(140, tests::sanitized ? 20 : 40),
                                    std::pair(900, tests::sanitized ? 5 : 25)}) {
    std::mt19937 random(static_cast<unsigned>(size));
    const double room = 1.3 * std::cbrt(size);
    Twins<S> twins, other;
    const Filter filters[] = {{}, {2, 1}, {1, 3}};
    const auto box = [&] { return random_box<S>(random, room); };
    for (int i = 0; i < size; ++i) twins.add(box());
    for (int i = 0; i < size / 7 + 2; ++i) other.add(box());
    for (int step = 0; step < steps; ++step) {
      const auto any = static_cast<std::uint32_t>(random() % twins.table().places());
      switch (random() % 6) {
        case 0:
          for (std::uint32_t i = 0; i < twins.table().places(); ++i)
            if (twins.table().object(i) != nullptr) twins.set.set_box(i, box());
          break;
        case 1:
          for (int i = 0; i < 60 && twins.table().size() > 3; ++i) {
            const auto place = static_cast<std::uint32_t>(random() % twins.table().places());
            if (twins.table().object(place) != nullptr) twins.set.remove(place);
          }
          break;
        case 2:
          for (int i = 0; i < 50; ++i) twins.add(box());
          break;
        case 3:
          if (step > steps / 2 && twins.table().object(any) != nullptr)
            twins.set.set_filter(any, filters[random() % 3], false);
          break;
        default:
          if (twins.table().object(any) != nullptr) twins.set.set_box(any, box());
      }
      ASSERT_NO_THROW(twins.set.validate());
      for (int i = 0; i < 20; ++i) expect_same_overlaps(twins, box(), filters[i % 3]);
      expect_same_pairs(twins, other);
      expect_same_pairs(other, twins);
      if (size < 200 || step % 8 == 0) {
        expect_same_distances(twins, other);
        ASSERT_NO_FATAL_FAILURE(expect_same_beginnings(twins, other));
      }
      for (int i = 0; i < 5; ++i) expect_least_distance(twins, box(), filters[i % 3]);
    }
  }
}

/// Of so few that their boxes are compared one by one, and of some more.
TYPED_TEST(ObjectSets, AFewThatComeAndGo) {
  using S = TypeParam;
  std::mt19937 random(11);
  const Filter filters[] = {{}, {2, 1}, {1, 3}};
  const auto box = [&] { return random_box<S>(random, 2.5); };
  for (int round = 0; round < (tests::sanitized ? 10 : 40); ++round) {
    const std::size_t most = 1 + random() % 11;
    Twins<S> twins, other;
    for (int step = 0; step < 60; ++step) {
      Twins<S>& changed = random() % 3 == 0 ? other : twins;
      const std::uint32_t places = changed.table().places();
      const auto any = static_cast<std::uint32_t>(random() % (places + 1));
      const bool is_there = any < places && changed.table().object(any) != nullptr;
      const auto what = random() % 8;
      if (what < 4 && changed.table().size() < most) changed.add(box());
      if (what >= 4 && what < 6 && is_there) changed.set.remove(any);
      if (what == 6 && is_there) changed.set.set_box(any, box());
      if (what == 7 && is_there && round % 2 == 0) changed.set.set_filter(any, filters[random() % 3], false);
      ASSERT_NO_THROW(changed.set.validate());
      for (int i = 0; i < 3; ++i) expect_same_overlaps(twins, box(), filters[i]);
      expect_same_pairs(twins, other);
      expect_same_pairs(other, twins);
      expect_same_distances(twins, other);
      expect_same_distances(other, twins);
      ASSERT_NO_FATAL_FAILURE(expect_same_beginnings(twins, other));
      ASSERT_NO_FATAL_FAILURE(expect_same_beginnings(other, twins));
      for (const Filter filter : filters) expect_least_distance(twins, box(), filter);
    }
  }
}

/// On a grid many distances are the limit itself, which is not below it.
TYPED_TEST(ObjectSets, DistancesThatAreTheLimit) {
  using S = TypeParam;
  std::mt19937 random(9);
  Twins<S> twins, other;
  for (int i = 0; i < 300; ++i) {
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<S>(random() % 24);
      box.max[d] = box.min[d] + static_cast<S>(random() % 3);
    }
    (i % 3 == 0 ? other : twins).add(box);
  }
  for (const S limit : {S(1), S(2), S(3), S(5), std::sqrt(S(2)), std::nextafter(S(5), S(6))}) {
    typename Twins<S>::Pairs cross;
    twins.set.for_each_near_pair(other.set, limit, [&](std::uint32_t a, std::uint32_t b) {
      cross.push_back({a, b});
      return limit;
    });
    ASSERT_EQ(sorted(cross), twins.all_near_pairs(other, limit));
    for (std::uint32_t i = 0; i < 50; ++i) {
      std::size_t count = 0;
      other.set.for_each_near(twins.table().box(i), {}, limit, [&](std::uint32_t) {
        ++count;
        return limit;
      });
      ASSERT_EQ(count, static_cast<std::size_t>(
                           std::count_if(cross.begin(), cross.end(), [&](auto pair) { return pair.first == i; })));
    }
  }
}

/// Boxes a little nearer than the limit are found, however their squares are rounded, and those at the limit are not.
TYPED_TEST(ObjectSets, JustNearerThanTheLimit) {
  using S = TypeParam;
  std::mt19937 random(5);
  for (int i = 0; i < 2000; ++i) {
    Twins<S> twins;
    for (int k = 0; k < 2; ++k) twins.add(random_box<S>(random, 8));
    const BasicAabb<S> boxes[2] = {twins.table().box(0), twins.table().box(1)};
    const S distance = detail::distance_below(boxes[0], boxes[1]);
    if (!tests::makes_sense(boxes[0]) || !tests::makes_sense(boxes[1]) || distance == 0) continue;
    for (const bool is_nearer : {false, true}) {
      const S limit = is_nearer ? std::nextafter(distance, inf<S>) : distance;
      std::size_t pairs = 0, boxes_near = 0;
      twins.set.for_each_near_pair(limit, [&](std::uint32_t, std::uint32_t) { return ++pairs, limit; });
      twins.set.for_each_near(boxes[0], {}, limit, [&](std::uint32_t) { return ++boxes_near, limit; });
      ASSERT_EQ(pairs, std::size_t{is_nearer}) << i;
      ASSERT_EQ(boxes_near, std::size_t{1} + is_nearer) << i;
    }
  }
}

/// Wherever one stops, what came is a beginning of the pairs.
TYPED_TEST(ObjectSets, PairsUpToAny) {
  using S = TypeParam;
  for (const int size : {5, 8, 20, 100, 400}) {
    std::mt19937 random(7);
    Twins<S> twins;
    for (int i = 0; i < size; ++i) twins.add(random_box<S>(random, std::cbrt(size)));
    for (int round = 0; round < 60; ++round) {
      const auto place = static_cast<std::uint32_t>(random() % static_cast<unsigned>(size));
      if (round % 2 == 1) twins.set.set_box(place, random_box<S>(random, std::cbrt(size)));
      const auto expected = twins.all_pairs(twins);
      if (expected.empty()) continue;
      const std::size_t most = 1 + random() % expected.size();
      typename Twins<S>::Pairs pairs;
      twins.set.for_each_pair([&](std::uint32_t a, std::uint32_t b) {
        pairs.push_back({a, b});
        return pairs.size() < most;
      });
      ASSERT_EQ(pairs.size(), most);
      ASSERT_TRUE(std::equal(pairs.begin(), pairs.end(), expected.begin()));
    }
  }
}

/// The work is that of what is near, whatever the levels of both trees are.
TYPED_TEST(ObjectSets, AFewBesideManyOpenWhatIsNear) {
  using S = TypeParam;
  std::mt19937 random(5);
  const std::size_t many = tests::sanitized ? 5000 : 40000;
  const double room = std::cbrt(static_cast<double>(many));
  std::vector<BasicAabb<S>> boxes;
  const auto fill = [&](detail::Bvh<S>& bvh, std::size_t count) {
    boxes.clear();
    while (boxes.size() < count) {
      const BasicAabb<S> box = random_box<S>(random, room);
      if (is_valid(box) && box.max[1] < inf<S> && box.min[0] > -inf<S>) boxes.push_back(box);
    }
    bvh.build(count, [&](std::uint32_t slot) { return boxes[slot]; });
  };
  detail::Bvh<S> large;
  fill(large, many);
  const auto ignore = [](detail::NearLimit<S>&, std::uint32_t, std::uint32_t, S) {};
  for (const std::size_t few : {1, 8, 9, 64, 65, 100, 200}) {
    detail::Bvh<S> small;
    fill(small, few);
    const auto opened = [&](const detail::Bvh<S>& x, const detail::Bvh<S>& y) {
      detail::NearVisits<S, decltype((ignore))> visits(S(0.05), ignore);
      return detail::visit_near(detail::NearSide<S>(x), detail::NearSide<S>(y), visits);
    };
    EXPECT_LT(opened(small, large), 40 * few + 40) << few;
    EXPECT_LT(opened(large, small), 40 * few + 40) << few;
  }
}

/// A way down to one pair that is near sets the limit, and what is left then is out of reach.
TYPED_TEST(ObjectSets, TheNearestPairIsAmongTheFirst) {
  using S = TypeParam;
  std::mt19937 random(15);
  std::uniform_real_distribution<S> in(0, 40), beside(42, 80);
  for (const std::size_t many : {9, 64, 300, 1000, 3000}) {
    detail::Bvh<S> x, y;
    const auto fill = [&](detail::Bvh<S>& bvh, std::size_t count, auto& first_axis) {
      std::vector<BasicAabb<S>> boxes;
      for (std::size_t i = 0; i < count; ++i) {
        const S place[3] = {first_axis(random), in(random), in(random)};
        boxes.push_back({{place[0], place[1], place[2]}, {place[0] + 1, place[1] + 1, place[2] + 1}});
      }
      bvh.build(count, [&](std::uint32_t slot) { return boxes[slot]; });
    };
    fill(x, many, in);
    fill(y, many / 4 + 1, beside);
    std::size_t offers = 0;
    const auto nearer = [&](detail::NearLimit<S>& limit, std::uint32_t a, std::uint32_t b, S) {
      ++offers;
      const S distance = detail::distance_below(x.box_at(a), y.box_at(b));
      if (limit.is_above(distance)) limit.set(distance);
    };
    detail::NearVisits<S, decltype((nearer))> visits(std::numeric_limits<S>::max(), nearer);
    const std::size_t opened = detail::visit_near(detail::NearSide<S>(x), detail::NearSide<S>(y), visits);
    S least = std::numeric_limits<S>::max();
    for (std::size_t a = 0; a < many; ++a)
      for (std::size_t b = 0; b < many / 4 + 1; ++b)
        least = std::min(least, detail::distance_below(x.box_at(a), y.box_at(b)));
    EXPECT_TRUE(visits.limit().is(least)) << many;
    EXPECT_LE(offers, 12u) << many;
    EXPECT_LE(opened, 150u) << many;
  }
}

/// The pair that a query begins with is one of boxes as they are now: of the sets that it is about, and of no others
/// that have been where they are.
TYPED_TEST(ObjectSets, TheFirstPairIsOfNow) {
  using S = TypeParam;
  const auto place = [](double x) { return BasicAabb<S>{{S(x), 0, 0}, {S(x + 1), 1, 1}}; };
  for (const std::uint32_t size : {2u, 3u, 20u, 200u}) {
    Twins<S> twins;
    for (std::uint32_t i = 0; i < size; ++i) twins.add(place(3 * i));
    std::unique_ptr<int> objects[2];
    for (auto& object : objects) object = std::make_unique<int>(0);
    std::optional<BasicObjectSet<S>> other;
    for (std::uint32_t turn = 0; turn < 12; ++turn) {
      const std::uint32_t a = turn % size, b = (turn + 1) % size;
      std::vector<std::uint32_t> first;
      const auto stop = [&](std::uint32_t x, std::uint32_t y) {
        first = {x, y};
        return S(0);
      };
      if (turn % 2 == 0) other.emplace();
      BasicObjectSet<S> moved;  // what is known goes where the set goes, or nowhere
      for (auto& object : objects) moved.add(object.get(), place(&object == objects ? 3 * a : 1e4), Filter{}, false);
      other = std::move(moved);
      // Of a list the first block is looked at, of a tree the way to what is near, within a set what is in one block.
      const bool is_list = size < 24;
      for (int time = 0; (!is_list || a < 8) && time < 2; ++time) {
        twins.set.for_each_near_pair(*other, inf<S>, stop);
        ASSERT_EQ(first, (std::vector<std::uint32_t>{a, 0})) << size << " " << turn;
      }
      twins.set.set_box(a, place(3 * b));
      for (int time = 0; is_list && a / 8 == b / 8 && time < 2; ++time) {
        twins.set.for_each_near_pair(inf<S>, stop);
        ASSERT_EQ(first, (std::vector<std::uint32_t>{std::min(a, b), std::max(a, b)})) << size << " " << turn;
      }
      twins.set.set_box(a, place(3 * a));
    }
  }
}

/// What has left is no part of what queries cost or find: a few objects stay few.
TYPED_TEST(ObjectSets, AFewOfWhichManyHaveLeft) {
  using S = TypeParam;
  using Twin = Twins<S>;
  std::mt19937 random(6);
  Twin twins, other;
  for (int i = 0; i < 300; ++i) other.add(random_box<S>(random, 8));
  for (int i = 0; i < 20; ++i) twins.add(random_box<S>(random, 8));
  for (int turn = 0; turn < 300; ++turn) {
    auto place = static_cast<std::uint32_t>(random() % twins.table().places());
    while (twins.table().object(place) == nullptr) place = (place + 1) % twins.table().places();
    twins.set.remove(place);
    twins.add(random_box<S>(random, 8), turn % 50 == 0 ? Filter{2, 3} : Filter{});
    // Some are gone before any query has seen them, and places change meanwhile.
    if (random() % 3 != 0) continue;
    ASSERT_NO_FATAL_FAILURE(expect_same_pairs(twins, other));
    ASSERT_NO_FATAL_FAILURE(expect_same_distances(twins, other));
    ASSERT_NO_FATAL_FAILURE(expect_least_distance(twins, random_box<S>(random, 8), Filter{}));
    ASSERT_NO_THROW(twins.set.validate());
  }
}

/// However many have been there: few have no gaps among them, keep their order and are found, though what was made of
/// many is still there when they become few.
TYPED_TEST(ObjectSets, FewHaveNoGaps) {
  using S = TypeParam;
  std::mt19937 random(12);
  for (const std::size_t many : {1, 8, 9, 10, 25, 200}) {
    Twins<S> twins, other;
    for (int i = 0; i < 4; ++i) other.add(random_box<S>(random, 3));
    for (int round = 0; round < 4; ++round) {
      while (twins.table().size() < many) twins.add(random_box<S>(random, 3), round == 2 ? Filter{2, 3} : Filter{});
      // What holds pairs and the index are made.
      expect_same_pairs(twins, other);
      expect_least_distance(twins, random_box<S>(random, 3), Filter{});
      std::vector<const void*> left;
      for (std::uint32_t i = 0; i < twins.table().places(); ++i)
        if (twins.table().object(i) != nullptr) left.push_back(twins.table().object(i));
      while (!left.empty()) {
        const std::size_t i = random() % left.size();
        twins.set.remove(twins.table().find(left[i]));
        ASSERT_EQ(twins.table().find(left[i]), Twins<S>::Set::none);
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        if (left.size() > 8) continue;
        ASSERT_EQ(twins.table().places(), left.size());
        for (std::uint32_t place = 0; place < left.size(); ++place) {
          ASSERT_EQ(twins.table().object(place), left[place]);
          ASSERT_EQ(twins.table().find(left[place]), place);
        }
        ASSERT_NO_THROW(twins.set.validate());
        ASSERT_NO_FATAL_FAILURE(expect_same_pairs(twins, other));
        ASSERT_NO_FATAL_FAILURE(expect_same_pairs(other, twins));
        ASSERT_NO_FATAL_FAILURE(expect_same_distances(twins, other));
        if (round == 3 && left.size() == 2) break;
      }
    }
  }
}

/// Of two sets of which one is three times as large, its index is made once batches have cost as much; nothing else
/// changes.
TYPED_TEST(ObjectSets, TwoThatAreAskedAgainAndAgain) {
  using S = TypeParam;
  std::mt19937 random(13);
  const auto bounded_box = [&] {
    for (;;)
      if (const auto box = random_box<S>(random, 8); is_valid(box) && box.max[1] < inf<S>) return box;
  };
  Twins<S> larger, smaller;
  for (int i = 0; i < 300; ++i) larger.add(bounded_box(), i % 7 == 0 ? Filter{2, 3} : Filter{});
  for (int i = 0; i < 90; ++i) smaller.add(random_box<S>(random, 8));
  const BasicAabb<S> beyond{{100, 100, 100}, {101, 101, 101}};
  for (std::uint32_t time = 0; time < 40; ++time) {
    const bool has_index = larger.set.is_clear(beyond);
    ASSERT_TRUE(time % 20 >= 2 || !has_index) << time;
    ASSERT_TRUE(time % 20 < 19 || has_index) << time;
    const Twins<S>& first = time % 2 == 0 ? larger : smaller;
    const Twins<S>& second = time % 2 == 0 ? smaller : larger;
    typename Twins<S>::Pairs pairs;
    first.set.for_each_pair(second.set, Twins<S>::Set::Order::any, [&](std::uint32_t a, std::uint32_t b) {
      pairs.push_back({a, b});
      return true;
    });
    ASSERT_EQ(sorted(pairs), first.all_pairs(second));
    if (time == 19)
      for (std::uint32_t place = 0; place < 300; ++place) larger.set.set_box(place, bounded_box());
  }
}

/// For the least distance few objects are looked at: of a list one, from outside.
TYPED_TEST(ObjectSets, TheNearestFirst) {
  using S = TypeParam;
  std::mt19937 random(7);
  for (const std::size_t n : {3, 8, 9, 20, 24, 25, 64, 100, 160, 1000}) {
    Twins<S> twins;
    std::uniform_real_distribution<double> at(0, 2 * std::cbrt(static_cast<double>(n)));
    for (std::size_t i = 0; i < n; ++i) {
      BasicAabb<S> box{};
      for (int d = 0; d < 3; ++d) box.max[d] = (box.min[d] = static_cast<S>(at(random))) + S(0.5);
      twins.add(box);
    }
    std::size_t calls = 0;
    constexpr std::size_t queries = 20;
    for (std::size_t i = 0; i < queries; ++i) {
      const S corner = static_cast<S>(-1 - at(random));
      const BasicAabb<S> box{{corner, corner, corner}, {corner + 1, corner + 1, corner + 1}};
      S least = inf<S>;
      twins.set.for_each_near(box, Filter{}, inf<S>, [&](std::uint32_t place) {
        ++calls;
        return least = std::min(least, detail::distance_below(twins.table().box(place), box));
      });
      S expected = inf<S>;
      for (std::uint32_t place = 0; place < n; ++place)
        expected = std::min(expected, detail::distance_below(twins.table().box(place), box));
      ASSERT_EQ(least, expected);
    }
    EXPECT_LE(calls, n <= 24 ? queries : 2 * queries) << n;
  }
}

TYPED_TEST(ObjectSets, EmptyAndMoved) {
  using S = TypeParam;
  using Set = BasicObjectSet<S>;
  Set empty;
  const BasicAabb<S> box{{0, 0, 0}, {1, 1, 1}};
  const auto fail = [](auto...) -> bool { throw std::logic_error("nothing is there"); };
  const auto fail_near = [](auto...) -> S { throw std::logic_error("nothing is there"); };
  empty.for_each_overlap(box, {}, Set::Order::any, [&](std::uint32_t p) { return fail(p); });
  empty.for_each_pair([&](std::uint32_t a, std::uint32_t b) { return fail(a, b); });
  empty.for_each_near(box, {}, 1, [&](std::uint32_t p) { return fail_near(p); });
  empty.for_each_near_pair(1, [&](std::uint32_t a, std::uint32_t b) { return fail_near(a, b); });
  empty.clear();
  empty.validate();

  int objects[2];
  Set set;
  for (int& object : objects) set.add(&object, box, {}, false);
  Set moved(std::move(set));
  set = Set();
  std::size_t count = 0;
  moved.for_each_pair([&](std::uint32_t, std::uint32_t) { return ++count > 0; });
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(moved.table().find(&objects[1]), 1u);
  EXPECT_EQ(set.table().find(&objects[1]), Set::none);
}

}  // namespace
}  // namespace boxstream
