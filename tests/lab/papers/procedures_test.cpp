// SPDX-License-Identifier: MIT
// Sets large enough for trees of many nodes, against the truth.
#include <gtest/gtest.h>

#include <limits>

#include "random.hpp"
#include "truth.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;

/// `largest[d]`: low ends in [0, spread[d]], lengths in [1, largest[d]].
std::vector<Box> scattered(std::size_t n, Random& random, const int (&spread)[3], const int (&largest)[3]) {
  std::vector<Box> boxes(n);
  for (Box& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const int lo = random.integer(0, spread[d]);
      box.projections[d] = {lo, lo + random.integer(1, largest[d])};
    }
  return boxes;
}

struct Kind {
  const char* name;
  int spread[3], largest[3];
};
constexpr Kind kinds[] = {
    {"few ties", {100000, 100000, 100000}, {30000, 30000, 30000}},
    {"many ties", {12, 12, 12}, {4, 4, 4}},
    {"one low end in dimension 2", {60, 60, 0}, {9, 9, 9}},
    {"one low end in dimensions 2 and 1", {300, 0, 0}, {9, 9, 9}},
    {"one low end in dimensions 2 and 0", {0, 300, 0}, {9, 9, 9}},
    {"plates across dimension 2", {50, 50, 200}, {50, 50, 2}},
    {"unit cubes on a lattice", {5, 5, 5}, {1, 1, 1}},
    {"all the same", {0, 0, 0}, {1, 1, 1}},
};

HybridOptions options_of(Random& random) {
  constexpr std::size_t cutoffs[] = {0, 1, 2, 5, 20, 1000};
  HybridOptions options;
  options.cutoffs = Cutoffs(cutoffs[random.index(6)], cutoffs[random.index(6)]);
  options.level = {10, random.integer(0, 2)};
  options.seed = random.index(1000);
  return options;
}

TEST(Procedures, CompleteCase) {
  for (const Kind& kind : kinds)
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Random random(seed);
      const auto boxes = scattered(40 + random.index(160), random, kind.spread, kind.largest);
      ASSERT_TRUE(check_all(boxes, options_of(random), kind.name + (", seed " + std::to_string(seed))));
    }
}

TEST(Procedures, BipartiteCase) {
  for (const Kind& kind : kinds)
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      Random random(seed);
      const auto a = scattered(random.index(200), random, kind.spread, kind.largest);
      const auto b = scattered(1 + random.index(200), random, kind.spread, kind.largest);
      ASSERT_TRUE(check_all(a, b, options_of(random), kind.name + (", seed " + std::to_string(seed))));
    }
}

TEST(Procedures, EmptySets) {
  const std::vector<Box> none, one{{{{0, 1}, {0, 1}, {0, 1}}}};
  EXPECT_TRUE(check_all(none, {}, "no box"));
  EXPECT_TRUE(check_all(one, {}, "one box"));
  EXPECT_TRUE(check_all(none, one, {}, "none against one"));
  EXPECT_TRUE(check_all(one, none, {}, "one against none"));
  EXPECT_TRUE(check_all(one, one, {}, "one against itself"));
}

/// The two infinities of the first call are values that ends may have.
TEST(Procedures, EndsOfTheIntegers) {
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min(),
                         most = std::numeric_limits<std::int32_t>::max();
  const Interval extreme[] = {
      {least, least + 1}, {least, most}, {most - 1, most}, {least + 1, most}, {least, most - 1}, {-1, 0}, {0, 1}};
  std::vector<Box> boxes;
  for (const Interval& x : extreme)
    for (const Interval& y : extreme)
      for (const Interval& z : extreme) boxes.push_back({{x, y, z}});
  for (const std::size_t c : {0u, 10u}) {
    HybridOptions options;
    options.cutoffs = Cutoffs(c);
    EXPECT_TRUE(check_all(boxes, options, "ends of the integers"));
    EXPECT_TRUE(check_all(boxes, boxes, options, "ends of the integers, two sets"));
  }
}

TEST(Procedures, SameSeedSameOrder) {
  Random random(7);
  const auto boxes = scattered(2000, random, {1000, 1000, 1000}, {99, 99, 99});
  HybridOptions options;
  options.cutoffs = Cutoffs(10);
  options.level = {100, 1};
  const auto order = [&](Procedure procedure) {
    return collect([&](auto&& found) { run(procedure, Span<const Box>(boxes), options, found); });
  };
  for (const Procedure procedure : procedures()) EXPECT_EQ(order(procedure), order(procedure)) << name(procedure);
  // The seed counts, though not for which pairs there are.
  Pairs one = order(Procedure::hybrid);
  options.seed = 2;
  Pairs other = order(Procedure::hybrid);
  EXPECT_NE(one, other);
  std::sort(one.begin(), one.end());
  EXPECT_TRUE(same_pairs(other, one, "another seed"));
}

}  // namespace
}  // namespace boxstream::papers::tests
