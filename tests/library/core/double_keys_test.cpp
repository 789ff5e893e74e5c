// SPDX-License-Identifier: MIT
// Of double boxes the search sees 32 bits of each bound: which ones, and that the other 32 are looked at where they
// matter.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <boxstream/detector.hpp>

#include "base/keys.hpp"
#include "batch/records/load.hpp"
#include "box_sets.hpp"
#include "fast_oracle.hpp"
#include "random.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

using detail::KeyKind;
using detail::KeyMap;

Boxes<double> cubes(std::size_t n, double centre, double extent, double side, Random& random) {
  Boxes<double> boxes(n);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = centre + random.between(-extent, extent);
      box.max[d] = box.min[d] + side;
    }
  return boxes;
}

/// Values of all magnitudes, and their neighbours.
std::vector<double> ascending_values() {
  std::vector<double> values{0.0, INFINITY};
  for (int exponent = -1074; exponent < 1024; exponent += 3)
    for (const double x : {std::ldexp(1.0, exponent), std::ldexp(1.37, exponent)})
      for (const double y : {std::nextafter(x, 0.0), x, std::nextafter(x, INFINITY)}) values.push_back(y);
  for (double x = -3; x < 3; x += 0.001) values.push_back(1e6 + x);
  for (std::size_t i = 0, size = values.size(); i < size; ++i) values.push_back(-values[i]);
  std::sort(values.begin(), values.end());
  return values;
}

TEST(DoubleKeys, AreMonotone) {
  Random random(1);
  const auto values = ascending_values();
  for (const double centre : {0.0, -1e-3, 1e6, -1e15, 1e300})
    for (const double extent : {1e-300, 1e-3, 1.0, 1e8}) {
      KeyMap<double> keys;
      keys.fit(cubes(500, centre, extent, extent / 50, random));
      for (std::size_t i = 1; i < values.size(); ++i)
        ASSERT_LE(keys(values[i - 1], 0), keys(values[i], 0)) << values[i - 1] << ' ' << values[i] << ' ' << centre;
      EXPECT_EQ(keys(-0.0, 0), keys(0.0, 0));
    }
}

/// As boxes are loaded, several coordinates at a time.
TEST(DoubleKeys, AreTheSameInRecords) {
  Random random(4);
  const auto values = ascending_values();
  for (const double centre : {0.0, -1e-3, 1e6, 1e300}) {
    KeyMap<double> keys;
    keys.fit(cubes(500, centre, 1, 0.01, random));
    for (const double x : values) {
      const Aabb64 box{{x, x, x}, {x, x, x}};
      detail::Record record;
      detail::load_records(&box, 1, 0, keys, &record);
      for (int d = 0; d < 3; ++d) {
        ASSERT_EQ(record.lo[d], keys(x, d)) << x << ' ' << centre;
        ASSERT_EQ(record.hi[d], keys(x, d)) << x << ' ' << centre;
      }
    }
  }
}

TEST(DoubleKeys, TellClustersBeyondTheWindowApart) {
  Random random(2);
  KeyMap<double> keys;
  keys.fit(cubes(500, 0, 1, 0.01, random));
  EXPECT_EQ(keys.kind(0), KeyKind::linear);
  for (double x = 4; x < 1e300; x *= 2) {
    EXPECT_LT(keys(x, 0), keys(1.01 * x, 0)) << x;
    EXPECT_GT(keys(-x, 0), keys(-1.01 * x, 0)) << x;
  }
  EXPECT_LT(keys(1e300, 0), keys(INFINITY, 0));
}

TEST(DoubleKeys, AreLeadingBitsWhereSizesGrowWithDistance) {
  Boxes<double> boxes;
  for (int i = 0; i < 300; ++i) {
    const double x = std::ldexp(1.0, i - 150);
    boxes.push_back({{x, x, x}, {1.5 * x, 1.5 * x, 1.5 * x}});
  }
  KeyMap<double> keys;
  keys.fit(boxes);
  EXPECT_EQ(keys.kind(0), KeyKind::float64);
}

/// A few boxes, scattered over a world so large that the window leaves them out, must not be compared all with all.
TEST(DoubleKeys, AFewFarBoxesCostNoMoreThanOthers) {
  Random random(3);
  constexpr std::size_t n = 40000;
  auto boxes = cubes(n, 0, 1, 0.01, random);
  for (std::size_t i = 0; i < n; i += 20) boxes[i] = cubes(1, 0, 1e4, 0.01, random)[0];
  random.shuffle(boxes);
  Detector detector;
  Pairs pairs;
  const Stats stats = detector.find_pairs(boxes, pairs);
  EXPECT_LE(stats.tests, 400 * n);
  ASSERT_TRUE(expect_same_pairs(pairs, sweep(boxes), boxes, "far", n));
}

/// Neighbours in a row that touch, or miss each other by the last bit.
TEST(DoubleKeys, TouchingIsDecidedByAllBits) {
  for (const double origin : {0.0, 1e3, -1e9}) {
    Boxes<double> boxes;
    for (int i = 0; i < 5000; ++i) {
      const double lo = origin + 2 * i, hi = origin + 2 * i + 2;
      boxes.push_back({{lo, 0, 0}, {i % 3 == 0 ? std::nextafter(hi, -INFINITY) : hi, 1, 1}});
    }
    Detector detector;
    Pairs pairs;
    detector.find_pairs(boxes, pairs);
    ASSERT_TRUE(expect_same_pairs(pairs, sweep(boxes), boxes, "row", 0));
    EXPECT_EQ(pairs.size(), 3332u);
  }
}

}  // namespace
}  // namespace boxstream::tests
