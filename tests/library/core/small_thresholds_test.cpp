// SPDX-License-Identifier: MIT
// Searches by the library compiled for small thresholds, with which a few dozen boxes go all ways that products keep
// for thousands.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <boxstream/detector.hpp>

#include "base/thresholds.hpp"
#include "batch/cuts/plan.hpp"
#include "box_sets.hpp"
#include "executors.hpp"
#include "random.hpp"
#include "rules_oracle.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class SmallThresholds : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SmallThresholds, Scalars);

/// Boxes of many sizes in a room, some of which are long, some flat, some begin at the same place, and a few are none.
template <class S>
Boxes<S> mixed(std::size_t n, Random& random) {
  Boxes<S> boxes(n);
  const double most = random.between(0.01, 0.5);
  const bool is_lattice = random.chance(0.3), is_near_one = random.chance(0.5);
  // Few long ones are taken out of rows and columns of the others.
  const std::size_t axes = random.chance(0.3) ? 200 : 12;
  for (auto& box : boxes) {
    const auto long_axis = static_cast<int>(random.index(axes));
    for (int d = 0; d < 3; ++d) {
      double at = is_lattice ? static_cast<double>(random.index(7)) / 7 : random.unit();
      if (is_lattice && is_near_one) at += random.integer(0, 2) * 1e-12;  // doubles that share the bits of a float
      const double size = d == long_axis ? random.unit() : random.chance(0.1) ? 0 : most * random.unit();
      box.min[d] = static_cast<S>(at);
      box.max[d] = static_cast<S>(at + size);
    }
    if (random.chance(0.02)) box.max[random.index(3)] = std::numeric_limits<S>::quiet_NaN();
  }
  return boxes;
}

Ids some_ids(std::size_t n, std::size_t different, Random& random) {
  Ids ids(n);
  for (std::uint32_t& id : ids) id = static_cast<std::uint32_t>(random.index(different));
  return ids;
}

/// Of kinds that accept each other by a rule, or at random: then classes of boxes differ in which others they accept.
Filters some_filters(std::size_t n, unsigned kinds, Random& random) {
  Filters filters(n);
  if (random.chance(0.5)) {
    Filters kind(kinds);
    for (unsigned k = 0; k < kinds; ++k) kind[k] = {1u << k, static_cast<std::uint32_t>(random.index(1u << kinds))};
    for (Filter& filter : filters) filter = kind[random.index(kinds)];
    return filters;
  }
  for (Filter& filter : filters) {
    const auto kind = static_cast<std::uint32_t>(random.index(kinds));
    filter = {1u << kind, kind % 3 == 0 ? ~(1u << kind) : 0xffu << kind / 2};
  }
  return filters;
}

/// Collected and streamed, of one set and two.
template <class S>
std::uint64_t expect_same(Detector& detector, const Boxes<S>& a, const Boxes<S>& b, const Filters& fa,
                          const Filters& fb, std::uint64_t seed) {
  Pairs found, streamed;
  const auto take = [&](Span<const Pair> pairs) {
    streamed.insert(streamed.end(), pairs.begin(), pairs.end());
    return true;
  };
  const Stats of_one = detector.find_pairs(a, found, fa);
  expect_same_pairs(found, brute_force(a, fa), a, "one set", seed);
  EXPECT_EQ(of_one.invalid, count_invalid(a)) << "seed " << seed;
  detector.stream_pairs(a, take, fa);
  EXPECT_EQ(streamed, found) << "seed " << seed;
  const Stats of_two = detector.find_pairs(a, b, found, fa, fb);
  expect_same_pairs(found, brute_force(a, b, fa, fb), a, b, "two sets", seed);
  EXPECT_EQ(of_two.invalid, count_invalid(a) + count_invalid(b)) << "seed " << seed;
  streamed.clear();
  detector.stream_pairs(a, b, take, fa, fb);
  EXPECT_EQ(streamed, found) << "seed " << seed;
  return of_one.nodes + of_two.nodes;
}

TYPED_TEST(SmallThresholds, EveryFamilyEqualsTruth) {
  for (const BoxSet<TypeParam>& set : box_sets_to_repeat<TypeParam>())
    for (const std::size_t n : {13, 30, 61, 130}) {
      const Boxes<TypeParam> a = set.make(std::min(n, set.largest), 1), b = set.make(std::min(n / 2, set.largest), 2);
      Detector detector;
      expect_same(detector, a, b, {}, {}, n);
      if (::testing::Test::HasFailure()) FAIL() << set.name;
    }
}

TYPED_TEST(SmallThresholds, AnyBoxesEqualTruth) {
  InlineExecutor four(4, 0);
  // Tasks that come before their turn hold their pairs, and are done again where there is no room.
  ReversedExecutor reversed(4);
  std::uint64_t nodes = 0;
  const std::uint64_t seeds = sanitized ? 100 : 600;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Random random(seed);
    const std::size_t n = 1 + random.index(seed % 10 == 0 ? 400 : 90), m = random.index(2 * n);
    const bool has_filters = random.chance(0.5);
    const auto kinds = 2 + static_cast<unsigned>(random.index(7));
    const auto a = mixed<TypeParam>(n, random), b = mixed<TypeParam>(m, random);
    const Filters fa = has_filters ? some_filters(n, kinds, random) : Filters(),
                  fb = has_filters ? some_filters(m, kinds, random) : Filters();
    Detector alone, shared({&four}), backwards({&reversed}), by_trees({&reversed, Method::hybrid});
    nodes += expect_same(alone, a, b, fa, fb, seed);
    nodes += expect_same(shared, a, b, fa, fb, seed);
    expect_same(backwards, a, b, fa, fb, seed);
    expect_same(by_trees, a, b, fa, fb, seed);
    if (this->HasFailure()) return;
  }
  EXPECT_GT(nodes, 10 * seeds) << "sets of this size are cut";
  EXPECT_GT(four.calls(), 2 * seeds) << "and shared";
}

/// By each method: found, streamed, and as neighbours.
template <class S>
void expect_by_rules(Detector& detector, const Boxes<S>& a, const Boxes<S>& b, const PairRules& rules,
                     std::uint64_t seed) {
  PairRules of_one = rules;
  of_one.filters_b = {};
  of_one.ids_b = {};
  Pairs found, streamed;
  const auto take = [&](Span<const Pair> pairs) {
    streamed.insert(streamed.end(), pairs.begin(), pairs.end());
    return true;
  };
  const Pairs one_set = brute(a, a, true, of_one), two_sets = brute(a, b, false, rules);
  detector.find_pairs(a, found, of_one);
  expect_same_pairs(found, one_set, a, "one set by rules", seed);
  detector.stream_pairs(a, take, of_one);
  EXPECT_EQ(streamed, found) << "seed " << seed;
  detector.find_pairs(a, b, found, rules);
  expect_same_pairs(found, two_sets, a, b, "two sets by rules", seed);
  streamed.clear();
  detector.stream_pairs(a, b, take, rules);
  EXPECT_EQ(streamed, found) << "seed " << seed;
  Neighbours neighbours;
  detector.find_neighbours(a, b, neighbours, rules);
  found.clear();
  for (std::uint32_t i = 0; i < a.size(); ++i)
    for (std::uint64_t at = neighbours.offsets[i]; at < neighbours.offsets[i + 1]; ++at)
      found.push_back({i, neighbours.indices[at]});
  EXPECT_EQ(found, two_sets) << "neighbours, seed " << seed;
}

TYPED_TEST(SmallThresholds, AnyRulesEqualTruth) {
  InlineExecutor four(4, 0);
  for (std::uint64_t seed = 1; seed <= (sanitized ? 150u : 1000u); ++seed) {
    Random random(seed);
    const std::size_t n = 1 + random.index(seed % 10 == 0 ? 300 : 90), m = random.index(2 * n);
    const auto a = mixed<TypeParam>(n, random), b = mixed<TypeParam>(m, random);
    const auto kinds = 2 + static_cast<unsigned>(random.index(7));
    const Filters fa = some_filters(n, kinds, random), fb = some_filters(m, kinds, random);
    const std::size_t different = 1 + random.index(2 * n);
    const Ids ia = some_ids(n, different, random), ib = some_ids(m, different, random);
    PairRules rules;
    rules.touching = random.chance(0.5);
    if (random.chance(0.5)) rules.tolerance = random.chance(0.5) ? 1.0 / 7 : random.between(0, 0.2);
    if (random.chance(0.3)) rules.filters = fa, rules.filters_b = fb;
    if (random.chance(0.5)) rules.ids = ia, rules.ids_b = ib;
    DetectorOptions options;
    if (random.chance(0.5)) options.executor = &four;
    if (random.chance(0.3)) options.method = Method::hybrid;
    options.cutoff = static_cast<std::uint32_t>(random.index(5));
    Detector detector(options);
    expect_by_rules(detector, a, b, rules, seed);
    if (this->HasFailure()) return;
  }
}

TYPED_TEST(SmallThresholds, ManySetsEqualTruth) {
  InlineExecutor four(4, 0);
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    Random random(seed);
    const auto boxes = mixed<TypeParam>(random.index(300), random);
    std::vector<std::uint64_t> offsets{0, boxes.size()};
    while (offsets.size() < 12) offsets.push_back(random.index(boxes.size() + 1));
    std::sort(offsets.begin(), offsets.end());
    const Ids ids = some_ids(boxes.size(), 40, random);
    PairRules rules;
    rules.touching = random.chance(0.5);
    if (random.chance(0.5)) rules.ids = ids;
    Pairs expected = brute(boxes, boxes, true, rules);
    const auto set_of = [&](std::uint32_t box) { return std::upper_bound(offsets.begin(), offsets.end(), box); };
    expected.erase(
        std::remove_if(expected.begin(), expected.end(), [&](Pair pair) { return set_of(pair.a) != set_of(pair.b); }),
        expected.end());
    PairsOfSets found;
    Detector({&four}).find_pairs(boxes, offsets, found, rules);
    ASSERT_TRUE(expect_same_pairs(found.pairs, expected, boxes, "many sets", seed));
    for (std::size_t set = 0; set + 1 < offsets.size(); ++set)
      for (std::uint64_t i = found.offsets[set]; i < found.offsets[set + 1]; ++i)
        ASSERT_EQ(set_of(found.pairs[i].a) - offsets.begin(), std::ptrdiff_t(set) + 1) << "seed " << seed;
  }
}

/// A sample that shows specks, in front of boxes that reach over much: where these would be copied to most cells, cuts
/// have one axis, and large boxes are apart.
TYPED_TEST(SmallThresholds, APlanThatMisleadsIsMadeSimpler) {
  struct Spy {
    std::vector<bool>& seen;
    std::size_t size() const { return seen.size(); }
    bool valid(std::size_t i) const { return seen[i] = true, false; }
    detail::Record operator[](std::size_t) const { return {}; }
  };
  constexpr double most[] = {0.38, 0.001, 0.15};
  std::uint64_t boxes = 0, records = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Boxes<TypeParam> set(800);
    std::vector<bool> seen(set.size());
    detail::Arena arena;
    detail::Sample(arena).draw(Spy{seen}, detail::Sample::wanted(set.size()));
    for (std::size_t i = 0; i < set.size(); ++i)
      for (int d = 0; d < 3; ++d) {
        set[i].min[d] = static_cast<TypeParam>(random.unit());
        set[i].max[d] = set[i].min[d] + static_cast<TypeParam>(seen[i] ? 0.02 : most[d] * random.unit());
      }
    for (std::size_t i = seed; i < set.size() && seed % 2 == 0; i += 31)  // valid ones close ranks
      if (!seen[i]) set[i].max[i % 3] = -1;
    Pairs found;
    const Stats stats = Detector().find_pairs(set, found);
    EXPECT_EQ(stats.invalid, count_invalid(set));
    ASSERT_TRUE(expect_same_pairs(found, brute_force(set), set, "specks shown", seed));
    boxes += stats.boxes;
    records += stats.records;
  }
  EXPECT_LE(10 * records, 34 * boxes) << static_cast<double>(records) / static_cast<double>(boxes)
                                      << " of each box; by plans that are kept, 3.57";
}

}  // namespace
}  // namespace boxstream::tests
