// SPDX-License-Identifier: MIT
//
// Rules of a search: open boxes, tolerances, ids, integers. Compared with brute force by its own predicates.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <boxstream/out_of_core.hpp>

#include "base/tolerance.hpp"
#include "batch/records/raise_ends.hpp"
#include "box_sets.hpp"
#include "executors.hpp"
#include "many_sets.hpp"
#include "random.hpp"
#include "rules_oracle.hpp"

namespace boxstream::tests {
namespace {

Pairs sorted(Pairs pairs) {
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

PairRules open_rules() {
  PairRules rules;
  rules.touching = false;
  return rules;
}

/// Whole coordinates, so that most boxes touch others, and many are flat on one axis or on all.
template <class S>
std::vector<BasicAabb<S>> on_a_grid(std::size_t n, int side, std::uint64_t seed) {
  Random random(seed);
  std::vector<BasicAabb<S>> boxes(n);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const int at = random.integer(-side, side);
      box.min[d] = static_cast<S>(at);
      box.max[d] = static_cast<S>(at + random.integer(0, 3));
    }
  return boxes;
}

template <class S>
class Rules : public testing::Test {
 protected:
  void expect_all(const Boxes<S>& boxes, const PairRules& rules, const std::string& what) {
    const Stats stats = detector_.find_pairs(boxes, found_, rules);
    EXPECT_EQ(sorted(found_), brute(boxes, boxes, true, rules)) << what << ", " << boxes.size() << " boxes";
    EXPECT_EQ(stats.pairs, found_.size());
    EXPECT_EQ(stats.invalid, count_invalid(boxes)) << what << ", " << boxes.size() << " boxes";
    Pairs by_hybrid;
    hybrid_.find_pairs(boxes, by_hybrid, rules);
    EXPECT_EQ(sorted(by_hybrid), sorted(found_)) << what << ", " << boxes.size() << " boxes, hybrid";
  }
  void expect_all(const Boxes<S>& a, const Boxes<S>& b, const PairRules& rules, const std::string& what) {
    const Stats stats = detector_.find_pairs(a, b, found_, rules);
    EXPECT_EQ(sorted(found_), brute(a, b, false, rules)) << what << ", " << a.size() << " and " << b.size() << " boxes";
    EXPECT_EQ(stats.invalid, count_invalid(a) + count_invalid(b)) << what;
    Pairs by_hybrid;
    hybrid_.find_pairs(a, b, by_hybrid, rules);
    EXPECT_EQ(sorted(by_hybrid), sorted(found_)) << what << ", " << a.size() << " and " << b.size() << ", hybrid";
  }

  Detector detector_, hybrid_{{nullptr, Method::hybrid, 8}};
  Pairs found_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Rules, Scalars);

TYPED_TEST(Rules, OpenBoxesOfEachFamily) {
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    for (const std::size_t n : {2, 9, 40, 64, 65, 130, 160, 161, 384, 385, 700, 1900}) {
      const auto a = set.make(std::min(n, set.largest), n), b = set.make(std::min(n / 2 + 1, set.largest), n + 1);
      this->expect_all(a, open_rules(), set.name);
      this->expect_all(a, b, open_rules(), set.name);
    }
}

TYPED_TEST(Rules, OpenBoxesThatAreFlatOrTouch) {
  for (const int side : {2, 8, 30})
    for (const std::size_t n : {3, 11, 50, 64, 150, 200, 1000, 4000}) {
      const auto a = on_a_grid<TypeParam>(n, side, n), b = on_a_grid<TypeParam>(n / 3 + 1, side, n + 1);
      this->expect_all(a, open_rules(), "grid of " + std::to_string(side));
      this->expect_all(a, b, open_rules(), "grid of " + std::to_string(side));
      this->expect_all(b, a, open_rules(), "grid of " + std::to_string(side));
    }
}

/// Culling, of either set; and cells of many boxes.
TYPED_TEST(Rules, OpenBoxesOfLargeSets) {
  auto large = on_a_grid<TypeParam>(12000, 40, 1);
  for (std::size_t i = 0; i < large.size(); ++i) large[i].min[2] += TypeParam(100), large[i].max[2] += TypeParam(100);
  auto small = on_a_grid<TypeParam>(1000, 40, 2);
  for (std::size_t i = 0; i < small.size(); i += 3) small[i].min[2] += TypeParam(60), small[i].max[2] += TypeParam(60);
  this->expect_all(large, small, open_rules(), "few meet");
  this->expect_all(small, large, open_rules(), "few meet");
}

TYPED_TEST(Rules, AFlatBoxPairsWithThoseInsideOfWhichItIs) {
  using S = TypeParam;
  const Boxes<S> boxes = {{{0, 0, 0}, {4, 4, 4}}, {{2, 1, 1}, {2, 3, 3}}, {{2, 2, 2}, {2, 2, 2}},
                          {{4, 1, 1}, {4, 3, 3}}, {{0, 0, 0}, {0, 4, 4}}, {{2, 0, 0}, {6, 4, 4}}};
  this->expect_all(boxes, open_rules(), "flat");
  EXPECT_EQ(sorted(this->found_), (Pairs{{0, 1}, {0, 2}, {0, 5}, {3, 5}}));
}

TYPED_TEST(Rules, OpenBoxesOfManySets) {
  Random random(5);
  ManySets<TypeParam> many;
  for (const std::size_t size : {0, 3, 11, 7, 2, 64, 12, 200, 1, 5000, 10})
    many.add(on_a_grid<TypeParam>(size, 4, size), random);
  PairRules rules = open_rules();
  rules.filters = many.filters;
  Ids ids(many.boxes.size());
  for (auto& id : ids) id = static_cast<std::uint32_t>(random.index(5));
  rules.ids = ids;
  PairsOfSets found;
  this->detector_.find_pairs(many.boxes, many.offsets, found, rules);
  for (std::size_t i = 0; i < many.size(); ++i) {
    const auto set = many.set(i);
    const auto filters = many.filters_of(i);
    const auto first = static_cast<std::size_t>(many.offsets[i]);
    PairRules own = open_rules();
    own.filters = filters;
    own.ids = Span<const std::uint32_t>(ids).subspan(first, set.size());
    Pairs expected = brute(set, set, true, own);
    for (Pair& pair : expected)
      pair = {pair.a + static_cast<std::uint32_t>(first), pair.b + static_cast<std::uint32_t>(first)};
    EXPECT_EQ(sorted({found.pairs.begin() + static_cast<std::ptrdiff_t>(found.offsets[i]),
                      found.pairs.begin() + static_cast<std::ptrdiff_t>(found.offsets[i + 1])}),
              expected)
        << "set " << i;
  }
}

TYPED_TEST(Rules, SameOrderByAnyExecutorAndStreamed) {
  const auto a = on_a_grid<TypeParam>(30000, 40, 7), b = on_a_grid<TypeParam>(20000, 40, 8);
  PairRules rules = open_rules();
  rules.tolerance = 0.5;
  Ids ids(a.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::uint32_t>(i * i % 7);
  rules.ids = ids;
  PairRules of_two = rules;
  of_two.ids_b = Span<const std::uint32_t>(ids).subspan(0, b.size());
  const auto collect = [&](Detector& detector, bool two) {
    Pairs pairs;
    const auto sink = [&](Span<const Pair> more) {
      pairs.insert(pairs.end(), more.begin(), more.end());
      return true;
    };
    two ? detector.stream_pairs(a, b, sink, of_two) : detector.stream_pairs(a, sink, rules);
    return pairs;
  };
  ThreadExecutor threads(3);
  Detector parallel({&threads});
  for (const bool two : {false, true}) {
    const Pairs expected = collect(this->detector_, two);
    EXPECT_EQ(expected.empty(), false);
    EXPECT_EQ(collect(parallel, two), expected);
    two ? parallel.find_pairs(a, b, this->found_, of_two) : parallel.find_pairs(a, this->found_, rules);
    EXPECT_EQ(this->found_, expected);
    if (two) continue;
    EXPECT_EQ(sorted(expected), brute(a, a, true, rules));
  }
}

TYPED_TEST(Rules, EqualIdsDoNotPair) {
  Random random(3);
  for (const std::uint32_t different : {1u, 2u, 40u, 4000000000u})
    for (const std::size_t n : {5, 100, 800, 3000}) {
      const auto a = on_a_grid<TypeParam>(n, 9, n), b = on_a_grid<TypeParam>(n / 2, 9, n + 1);
      Ids ids(a.size()), ids_b(b.size());
      for (auto* of : {&ids, &ids_b})
        for (auto& id : *of) id = static_cast<std::uint32_t>(random.index(different));
      Filters filters(a.size());
      for (auto& filter : filters) filter = {1u << random.index(2), static_cast<std::uint32_t>(random.integer(1, 3))};
      PairRules rules;
      rules.ids = ids;
      this->expect_all(a, rules, "ids");
      rules.filters = filters;
      this->expect_all(a, rules, "ids and filters");
      rules.ids_b = ids_b;
      this->expect_all(a, b, rules, "ids of two sets");
    }
}

TYPED_TEST(Rules, IdsAreNoneOrOneForEachBox) {
  const auto boxes = on_a_grid<TypeParam>(10, 9, 1);
  const Ids nine(9), ten(10);
  PairRules rules;
  rules.ids = nine;
  EXPECT_THROW(this->detector_.find_pairs(boxes, this->found_, rules), std::invalid_argument);
  rules.ids = ten;
  EXPECT_NO_THROW(this->detector_.find_pairs(boxes, this->found_, rules));
  EXPECT_THROW(this->detector_.find_pairs(boxes, boxes, this->found_, rules), std::invalid_argument);
  rules.ids = {};
  rules.ids_b = ten;
  EXPECT_THROW(this->detector_.find_pairs(boxes, boxes, this->found_, rules), std::invalid_argument);
}

/// Coordinates between 1 and 1024, of which sums with most tolerances are no coordinates.
template <class S>
Boxes<S> with_many_digits(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes(n);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const double at = random.between(1, 60);
      box.min[d] = static_cast<S>(at);
      box.max[d] = static_cast<S>(at + random.between(0, 4));
    }
  return boxes;
}

TYPED_TEST(Rules, ATolerance) {
  for (const double tolerance : {0.1, 1.0, 2.5, 1e-7, 1e-300, 100.0})
    for (const bool touching : {true, false}) {
      PairRules rules;
      rules.tolerance = tolerance;
      rules.touching = touching;
      for (const std::size_t n : {30, 400, 2500}) {
        this->expect_all(with_many_digits<TypeParam>(n, n), rules, "tolerance " + std::to_string(tolerance));
        this->expect_all(on_a_grid<TypeParam>(n, 20, n), rules, "tolerance " + std::to_string(tolerance));
        this->expect_all(on_a_grid<TypeParam>(n, 20, n), with_many_digits<TypeParam>(n / 2, n), rules, "two sets");
      }
    }
}

/// Pairs whose gap is the tolerance to the last bit, and one bit off, which a rounded sum would not tell.
TYPED_TEST(Rules, AToleranceIsNotRounded) {
  using S = TypeParam;
  Random random(11);
  for (int trial = 0; trial < 4000; ++trial) {
    const S end = static_cast<S>(random.between(1, 1000) * (random.chance(0.5) ? 1 : -1));
    const double tolerance = random.chance(0.5) ? random.between(0, 2) : random.between(0, 1e-6);
    S begin = static_cast<S>(double(end) + tolerance);
    for (int steps = random.integer(-2, 2); steps != 0; steps += steps < 0 ? 1 : -1)
      begin = std::nextafter(begin, steps < 0 ? S(-1e9) : S(1e9));
    const Boxes<S> boxes = {{{S(-2000), 0, 0}, {end, 1, 1}}, {{begin, 0, 0}, {S(2000), 1, 1}}};
    for (const bool touching : {true, false}) {
      PairRules rules;
      rules.tolerance = tolerance;
      rules.touching = touching;
      this->expect_all(boxes, rules, "gap");
      if (this->HasFailure()) return;
    }
  }
}

TYPED_TEST(Rules, AToleranceAtTheEndsOfTheRange) {
  using S = TypeParam;
  using Limits = std::numeric_limits<S>;
  constexpr S inf = Limits::infinity(), most = Limits::max(), least = Limits::denorm_min();
  const auto pairs_at = [&](S end, S begin, double tolerance, bool touching) {
    PairRules rules;
    rules.tolerance = tolerance;
    rules.touching = touching;
    this->detector_.find_pairs(Boxes<S>{{{-inf, 0, 0}, {end, 1, 1}}, {{begin, 0, 0}, {inf, 1, 1}}}, this->found_,
                               rules);
    return this->found_.size();
  };
  EXPECT_EQ(pairs_at(most, inf, 1e300, true), 0u) << "infinity is near nothing finite";
  EXPECT_EQ(pairs_at(0, most, double(most), true), 1u);
  EXPECT_EQ(pairs_at(0, most, double(most), false), 0u);
  EXPECT_EQ(pairs_at(-least, least, 1e-300, true), sizeof(S) == 8 ? 1u : 0u);
  EXPECT_EQ(pairs_at(0, least, double(least), true), 1u);
  EXPECT_EQ(pairs_at(0, least, double(least), false), 0u);
  EXPECT_EQ(pairs_at(-least, 0, double(least), true), 1u);
  EXPECT_EQ(pairs_at(-least, S(-0.0), double(least), false), 0u);
  EXPECT_EQ(pairs_at(inf, inf, 1, false), 0u) << "an end at infinity is one that touches";
  for (const double wrong : {-1.0, -1e-300, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THROW(pairs_at(0, 1, wrong, true), std::invalid_argument);
  EXPECT_NO_THROW(pairs_at(0, 1, -0.0, true));
}

TYPED_TEST(Rules, WhatIsInvalidStaysSoWithATolerance) {
  auto boxes = on_a_grid<TypeParam>(500, 5, 3);
  for (std::size_t i = 0; i < boxes.size(); i += 4) {
    boxes[i].min[i % 3] = boxes[i].max[i % 3] + 1;
    boxes[i + 1].max[i % 3] = std::numeric_limits<TypeParam>::quiet_NaN();
  }
  PairRules rules;
  rules.tolerance = 5;
  this->expect_all(boxes, rules, "invalid ones");
}

template <class I>
class IntegerBoxes : public testing::Test {};
using Integers = testing::Types<std::int32_t, std::int64_t>;
TYPED_TEST_SUITE(IntegerBoxes, Integers);

TYPED_TEST(IntegerBoxes, AreExact) {
  using I = TypeParam;
  Detector detector;
  Pairs found;
  constexpr I most = sizeof(I) == 4 ? std::numeric_limits<I>::max() : static_cast<I>(std::int64_t{1} << 53);
  // Close to each other far from zero, where floats would be the same; at the ends of what is allowed.
  for (const I centre : {I(0), I(1 << 30), I(-2139095000), I(2139095000), I(most - 100), I(100 - most)})
    for (const bool touching : {true, false})
      for (const double tolerance : {0.0, 1.0, 2.5, 1e30})
        for (const std::size_t n : {20, 150, 2000}) {
          auto boxes = on_a_grid<I>(n, 12, n);
          for (auto& box : boxes)
            for (int d = 0; d < 3; ++d) {
              box.min[d] = static_cast<I>(box.min[d] + centre);
              box.max[d] = static_cast<I>(box.max[d] + centre);
            }
          boxes[3].min[0] = boxes[3].max[0] + 1;  // invalid
          PairRules rules;
          rules.touching = touching;
          rules.tolerance = tolerance;
          detector.find_pairs(boxes, found, rules);
          ASSERT_EQ(sorted(found), brute(boxes, boxes, true, rules)) << centre << ' ' << tolerance << ' ' << n;
          const std::vector<BasicAabb<I>> some(boxes.begin(), boxes.begin() + 9);
          detector.find_pairs(some, boxes, found, rules);
          ASSERT_EQ(sorted(found), brute(some, boxes, false, rules)) << centre << ' ' << tolerance << ' ' << n;
        }
}

TYPED_TEST(IntegerBoxes, AtTheEndsOfTheirRange) {
  using I = TypeParam;
  constexpr I most = sizeof(I) == 4 ? std::numeric_limits<I>::max() : static_cast<I>(std::int64_t{1} << 53);
  constexpr I least = sizeof(I) == 4 ? std::numeric_limits<I>::min() : static_cast<I>(-(std::int64_t{1} << 53));
  const std::vector<BasicAabb<I>> boxes = {{{least, least, least}, {most, most, most}},
                                           {{most, 0, least}, {most, 0, most}},
                                           {{least, 0, 0}, {least, 0, 0}},
                                           {{static_cast<I>(most - 1), 0, 0}, {most, 1, 1}},
                                           {{-1, -1, -1}, {0, 0, 0}},
                                           {{0, 0, 0}, {1, 1, 1}}};
  for (const bool touching : {true, false})
    for (const double tolerance : {0.0, 1.0, 1e9, 1e19}) {
      PairRules rules;
      rules.touching = touching;
      rules.tolerance = tolerance;
      EXPECT_EQ(sorted(find_pairs(boxes, rules)), brute(boxes, boxes, true, rules)) << touching << ' ' << tolerance;
    }
}

TEST(LargeIntegers, AreRefused) {
  constexpr std::int64_t most = std::int64_t{1} << 53;
  for (const std::int64_t beyond : {most + 1, -most - 1, INT64_MAX, INT64_MIN}) {
    std::vector<IntAabb64> boxes(3);
    boxes[1].min[2] = boxes[1].max[2] = beyond;
    EXPECT_THROW(find_pairs(boxes), std::invalid_argument);
    EXPECT_THROW(find_pairs(Boxes<float>(2), boxes), std::invalid_argument);
  }
}

TEST(MixedSets, AreComparedExactly) {
  PairRules rules;
  for (const bool touching : {true, false}) {
    rules.touching = touching;
    rules.tolerance = 0;
    const auto floats = with_many_digits<float>(800, 1), more = on_a_grid<float>(500, 20, 2);
    auto doubles = with_many_digits<double>(800, 3);
    for (std::size_t i = 0; i < 400; ++i) doubles[i].min[0] = std::nextafter(double(floats[i].max[0]), 1000.0);
    for (std::size_t i = 0; i < 400; ++i) doubles[i].max[0] = std::max(doubles[i].min[0], doubles[i].max[0]);
    const auto integers = on_a_grid<std::int32_t>(700, 20, 4);
    const auto wide = on_a_grid<std::int64_t>(300, 20, 4);
    EXPECT_EQ(sorted(find_pairs(floats, doubles, rules)), brute(floats, doubles, false, rules));
    EXPECT_EQ(sorted(find_pairs(integers, more, rules)), brute(integers, more, false, rules));
    EXPECT_EQ(sorted(find_pairs(doubles, wide, rules)), brute(doubles, wide, false, rules));
    EXPECT_EQ(sorted(find_pairs(wide, integers, rules)), brute(wide, integers, false, rules));
    // Integers may be less than one apart from other numbers.
    auto halves = on_a_grid<double>(500, 40, 5);
    for (auto& box : halves)
      for (int d = 0; d < 3; ++d) box.min[d] /= 2, box.max[d] /= 2;
    for (const double tolerance : {0.5, 1.0, 1.5, 0.1}) {
      rules.tolerance = tolerance;
      EXPECT_EQ(sorted(find_pairs(integers, halves, rules)), brute(integers, halves, false, rules)) << tolerance;
      EXPECT_EQ(sorted(find_pairs(halves, wide, rules)), brute(halves, wide, false, rules)) << tolerance;
      EXPECT_EQ(sorted(find_pairs(wide, integers, rules)), brute(wide, integers, false, rules)) << tolerance;
    }
  }
}

/// Copied in vectors, boxes with a tolerance are those of one number after the other, but for the sign of
/// zero.
TEST(Tolerances, RaiseBoxesInVectors) {
  constexpr float inf = std::numeric_limits<float>::infinity(), most = std::numeric_limits<float>::max();
  const float hard[] = {0,    -0.f,  1e-45f, -1e-45f, 1,     -1, 2,        -2,           0.1f,
                        most, -most, inf,    -inf,    1e30f, 7,  16777216, std::nanf("")};
  Random random(11);
  for (const double tolerance : {0.0, 1e-300, 1e-45, 1e-9, 0.1, 1.0, 2.0, 1e30, 1e300, 1.7e308})
    for (const std::size_t n : {0, 1, 2, 3, 9, 17, 300}) {
      Boxes<float> boxes(n);
      for (std::size_t i = 0; i < n; ++i)
        for (int d = 0; d < 3; ++d) {
          const auto number = [&] {
            return random.index(4) != 0 || n < 300 ? float(random.between(-10, 10))
                                                   : hard[random.index(std::size(hard))];
          };
          boxes[i].min[d] = number();
          boxes[i].max[d] = std::max(boxes[i].min[d], number());
        }
      if (n > 3) boxes[3] = {{1, 1, 1}, {0, 2, 2}};
      for (const auto faces : {detail::Faces::closed, detail::Faces::open}) {
        Boxes<float> found(n), expected = boxes;
        for (Aabb& box : expected)
          if (makes_sense(box)) detail::raise(box, tolerance, faces);
        detail::raise_ends(boxes, tolerance, faces, found.data());
        for (std::size_t i = 0; i < n; ++i)
          ASSERT_TRUE(found[i] == expected[i] || std::memcmp(&found[i], &expected[i], sizeof(Aabb)) == 0)
              << tolerance << ", box " << i << " of " << n;
      }
    }
}

TEST(RoundedOutwards, ContainTheirBoxAndNothingSmallerDoes) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  Random random(9);
  std::vector<double> numbers = {0.0,    -0.0,   0.1,     -0.1,   1.0,    1e300,
                                 -1e300, 1e-300, -1e-300, 3.4e38, 3.5e38, double(inf)};
  for (int i = 0; i < 1000; ++i) numbers.push_back(random.between(-1000, 1000));
  for (const double x : numbers) {
    const Aabb out = rounded_outwards({{x, x, x}, {x, x, x}});
    EXPECT_LE(double(out.min[1]), x);
    EXPECT_GE(double(out.max[1]), x);
    EXPECT_TRUE(out.min[1] == inf || double(std::nextafter(out.min[1], inf)) > x) << x;
    EXPECT_TRUE(out.max[1] == -inf || double(std::nextafter(out.max[1], -inf)) < x) << x;
  }
  EXPECT_FALSE(is_valid(rounded_outwards({{std::nan(""), 0, 0}, {1, 1, 1}})));
}

/// What a call could be given before there were rules, and what it can be given in short.
TEST(Calls, AreAsTheyWere) {
  const Boxes<float> boxes(4);
  const Aabb array[2] = {};
  const Filters filters(4);
  const std::vector<std::uint64_t> sets = {0, 2, 4};
  Pairs found;
  PairsOfSets of_sets;
  const auto sink = [](Span<const Pair>) { return true; };
  Detector detector;
  EXPECT_EQ(detector.find_pairs(boxes, found).pairs, 6u);
  EXPECT_EQ(detector.find_pairs(boxes, found, {}).pairs, 6u);
  EXPECT_EQ(detector.find_pairs(boxes, found, filters).pairs, 6u);
  EXPECT_EQ(detector.find_pairs(boxes, found, {filters}).pairs, 6u);
  EXPECT_EQ(detector.find_pairs(boxes, found, {filters.data(), filters.size()}).pairs, 6u);
  EXPECT_EQ(detector.find_pairs({boxes.data(), 3}, found, PairRules{.touching = false}).pairs, 0u);
  EXPECT_EQ(detector.find_pairs(array, boxes, found, {}, filters).pairs, 8u);
  EXPECT_EQ(detector.find_pairs(array, boxes, found, Filters(2), filters).pairs, 8u);
  EXPECT_EQ(detector.find_pairs(array, boxes, found, Filters(2)).pairs, 8u);
  EXPECT_EQ(detector.find_pairs(boxes, sets, of_sets, filters).pairs, 2u);
  EXPECT_EQ(detector.find_pairs(boxes, sets, boxes, sets, of_sets, filters, filters).pairs, 8u);
  EXPECT_EQ(detector.stream_pairs(boxes, sink, filters).pairs, 6u);
  EXPECT_EQ(detector.stream_pairs(array, boxes, sink, {}, filters).pairs, 8u);
  EXPECT_EQ(detector.stream_pairs(boxes, sets, sink, filters).pairs, 2u);
  EXPECT_EQ(detector.stream_pairs(boxes, sets, boxes, sets, sink, filters).pairs, 8u);
  EXPECT_EQ(detector.find_pairs(boxes, found, {.touching = false}).pairs, 0u);
}

}  // namespace
}  // namespace boxstream::tests
