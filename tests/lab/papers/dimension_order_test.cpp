// SPDX-License-Identifier: MIT
#include "papers/hybrid/dimension_order.hpp"

#include <gtest/gtest.h>

#include "random.hpp"
#include "truth.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;

constexpr DimensionOrder orders[] = {{{0, 1, 2}}, {{0, 2, 1}}, {{1, 0, 2}}, {{1, 2, 0}}, {{2, 0, 1}}, {{2, 1, 0}}};

/// Low ends in [0, spread[d]], lengths in [1, longest[d]].
std::vector<Box> scattered(std::size_t n, std::uint64_t seed, const int (&spread)[3], const int (&longest)[3]) {
  Random random(seed);
  std::vector<Box> boxes(n);
  for (Box& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const int lo = random.integer(0, spread[d]);
      box.projections[d] = {lo, lo + random.integer(1, longest[d])};
    }
  return boxes;
}

TEST(DimensionOrder, PutsTheDimensionsInThatOrder) {
  const std::vector<Box> box{{{{0, 1}, {2, 3}, {4, 5}}}};
  const Box seen = reordered(Span<const Box>(box), {{2, 0, 1}})[0];
  EXPECT_EQ(seen.projections[0].lo, 4);
  EXPECT_EQ(seen.projections[1].lo, 0);
  EXPECT_EQ(seen.projections[2].lo, 2);
}

TEST(DimensionOrder, KeepsThePairs) {
  const auto boxes = scattered(150, 1, {40, 90, 200}, {9, 30, 20});
  for (const DimensionOrder order : orders) EXPECT_EQ(truth(reordered(Span<const Box>(boxes), order)), truth(boxes));
}

/// `spread` and `longest` by dimension; the order found from `first`.
DimensionOrder found(const int (&spread)[3], const int (&longest)[3], DimensionOrder first = {}) {
  const auto a = scattered(2000, 2, spread, longest), b = scattered(2000, 3, spread, longest);
  return dividing_order(Span<const Box>(a), Span<const Box>(b), {}, first);
}

TEST(DimensionOrder, StaysWhereTheFirstTreeDivides) {
  EXPECT_EQ(found({2000, 2000, 2000}, {100, 100, 100}), DimensionOrder{});
  EXPECT_EQ(found({0, 0, 2000}, {2000, 2000, 100}), DimensionOrder{});
  EXPECT_EQ(found({0, 2000, 0}, {2000, 100, 2000}, {{0, 2, 1}}), (DimensionOrder{{0, 2, 1}}));
}

TEST(DimensionOrder, RestartsWhereLowEndsAreAlike) {
  EXPECT_EQ(found({2000, 2000, 0}, {100, 100, 2000}), (DimensionOrder{{0, 2, 1}}));
  EXPECT_EQ(found({2000, 0, 0}, {100, 2000, 2000}), (DimensionOrder{{2, 1, 0}}));
  EXPECT_EQ(found({0, 2000, 0}, {2000, 100, 2000}, {{1, 0, 2}}), (DimensionOrder{{2, 0, 1}}));
}

TEST(DimensionOrder, RestartsWhereIntervalsSpanMostNodes) {
  EXPECT_EQ(found({2000, 2000, 2000}, {100, 100, 2000}), (DimensionOrder{{0, 2, 1}}));
  EXPECT_EQ(found({2000, 2000, 2000}, {100, 2000, 2000}), (DimensionOrder{{2, 1, 0}}));
  EXPECT_EQ(found({2000, 2000, 2000}, {2000, 100, 2000}), (DimensionOrder{{0, 2, 1}}));
}

TEST(DimensionOrder, StaysWhereNoTreeDivides) {
  EXPECT_EQ(found({2000, 2000, 2000}, {4000, 4000, 4000}), DimensionOrder{});
  EXPECT_EQ(found({0, 0, 0}, {1, 1, 1}, {{1, 2, 0}}), (DimensionOrder{{1, 2, 0}}));
}

TEST(DimensionOrder, OfNoBoxes) {
  EXPECT_EQ(dividing_order({}, {}, {}, {{2, 1, 0}}), (DimensionOrder{{2, 1, 0}}));
}

}  // namespace
}  // namespace boxstream::papers::tests
