// SPDX-License-Identifier: MIT
// Monotone maps keep every overlap, and outward ones contain what they were made of.
#include "boxes/conversions.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>

namespace boxstream::report {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Numbers around those that floats have, far from the origin too, and some that break arithmetic.
rc::Gen<double> number() {
  const auto near = rc::gen::map(
      rc::gen::tuple(rc::gen::inRange(-40, 40), rc::gen::inRange(-3, 4), rc::gen::element(0.0, 1e3, 1e7, -1e8, 1e300)),
      [](const std::tuple<int, int, double>& from) {
        const auto [place, steps, offset] = from;
        double value = place / 8.0 + offset;
        for (int i = 0; i < std::abs(steps); ++i) value = std::nextafter(value, steps < 0 ? -infinity : infinity);
        return value;
      });
  return rc::gen::weightedOneOf<double>(
      {{8, near},
       {1, rc::gen::element(infinity, -infinity, 0.0, -0.0, std::numeric_limits<double>::denorm_min(),
                            std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest(), 1e-60)}});
}

rc::Gen<Aabb64> box() {
  return rc::gen::map(rc::gen::container<std::vector<double>>(6, number()), [](const std::vector<double>& from) {
    Aabb64 made{};
    for (std::size_t d = 0; d < 3; ++d) {
      made.min[d] = std::min(from[2 * d], from[2 * d + 1]);
      made.max[d] = std::max(from[2 * d], from[2 * d + 1]);
    }
    return made;
  });
}

/// Near the middle of a lattice of 1/8.
rc::Gen<Aabb> small_box() {
  return rc::gen::map(rc::gen::container<std::vector<int>>(6, rc::gen::inRange(-90, 90)),
                      [](const std::vector<int>& from) {
                        Aabb made{};
                        for (std::size_t d = 0; d < 3; ++d) {
                          const auto [low, high] = std::minmax(from[2 * d], from[2 * d + 1]);
                          made.min[d] = static_cast<float>(low) / 16;
                          made.max[d] = static_cast<float>(high) / 16;
                        }
                        return made;
                      });
}

RC_GTEST_PROP(Conversions, NearestFloatsKeepEveryOverlap, ()) {
  const Aabb64 a = *box(), b = *box();
  RC_PRE(overlaps(a, b));
  RC_ASSERT(overlaps(nearest_floats(a), nearest_floats(b)));
}

RC_GTEST_PROP(Conversions, OutwardFloatsContainTheBoxAndKeepEveryOverlap, ()) {
  const Aabb64 a = *box(), b = *box();
  RC_ASSERT(contains(outward_floats(a), a));
  if (overlaps(a, b)) RC_ASSERT(overlaps(outward_floats(a), outward_floats(b)));
}

RC_GTEST_PROP(Conversions, OutwardFloatsAreTheSmallest, ()) {
  const Aabb64 a = *box();
  const Aabb outward = outward_floats(a);
  for (int d = 0; d < 3; ++d) {
    constexpr float far = std::numeric_limits<float>::infinity();
    if (outward.min[d] < far) RC_ASSERT(static_cast<double>(std::nextafter(outward.min[d], far)) > a.min[d]);
    if (outward.max[d] > -far) RC_ASSERT(static_cast<double>(std::nextafter(outward.max[d], -far)) < a.max[d]);
  }
}

TEST(Conversions, OutwardFloatsDoNotDependOnTheRoundingMode) {
  volatile double third = 1.0 / 3;
  const Aabb64 box{{-third, third, -1e300}, {third, 1e9 + third, 1e300}};
  const Aabb expected = outward_floats(box);
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    ASSERT_EQ(std::fesetround(mode), 0);
    const Aabb outward = outward_floats(box);
    std::fesetround(FE_TONEAREST);
    EXPECT_EQ(outward, expected) << mode;
  }
}

TEST(Conversions, NearestFloatsMayCutABoxOff) {
  const Aabb64 box{{1e8 + 1, 0, 0}, {1e8 + 2, 1, 1}};
  EXPECT_FALSE(contains(nearest_floats(box), box));
  EXPECT_TRUE(contains(outward_floats(box), box));
  EXPECT_EQ(outward_floats(box).max[0] - outward_floats(box).min[0], 8.0F);
}

RC_GTEST_PROP(Lattice, IsMonotoneSoItKeepsEveryOverlap, ()) {
  // Boxes inside the world, across its ends and beyond them.
  const Lattice16 lattice({{-3, -3, -1e4}, {3, 3, 1e4}});
  const Aabb a = *small_box(), b = *small_box();
  const Aabb on_a = lattice.outward(a), on_b = lattice.outward(b);
  for (int d = 0; d < 3; ++d) {
    RC_ASSERT(on_a.min[d] <= a.min[d] && a.max[d] <= on_a.max[d]);
    if (a.min[d] <= b.min[d]) RC_ASSERT(on_a.min[d] <= on_b.min[d]);
    if (a.max[d] <= b.max[d]) RC_ASSERT(on_a.max[d] <= on_b.max[d]);
  }
  if (overlaps(a, b)) RC_ASSERT(overlaps(on_a, on_b));
}

TEST(Lattice, HasCellsOfTheWorldsSizeAndMinimaOnEvenPlaces) {
  const Lattice16 lattice({{0, 0, 0}, {65536, 65536, 65536}});
  EXPECT_EQ(lattice.cell()[0], 1.0);
  const Aabb box = lattice.outward({{4.5F, 5.5F, 6}, {4.75F, 5.75F, 7}});
  EXPECT_EQ(box.min[0], 4);
  EXPECT_EQ(box.min[1], 4);
  EXPECT_EQ(box.min[2], 6);
  for (const float high : {box.max[0], box.max[1]}) {
    EXPECT_LT(high, 6);
    EXPECT_GT(high, 5.99F);
  }
  EXPECT_FALSE(overlaps(box, lattice.outward({{4, 4, 8}, {6, 6, 9}})));
}

TEST(CubeAround, HasTheLongestSideAndTheCentre) {
  const Aabb cube = cube_around({{0, 10, -1}, {4, 12, 0}});
  EXPECT_EQ(cube, (Aabb{{0, 9, -2.5F}, {4, 13, 1.5F}}));
}

}  // namespace
}  // namespace boxstream::report
