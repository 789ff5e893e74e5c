// SPDX-License-Identifier: MIT
// Doubles whose ends coincide or are neighbours, on axes where all keys lose bits, or none, or those of a few.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boxstream/detector.hpp>

#include "base/keys.hpp"
#include "batch/records/load.hpp"
#include "checks.hpp"
#include "many_sets.hpp"
#include "random.hpp"

namespace boxstream::tests {
namespace {

using Grid = double (*)(int);

/// Places that bounds share on one axis, and how often a bound is a neighbour of its place instead.
struct Axis {
  std::string name;
  Grid place;
  double beside;
};

double whole(int k) {
  return k;
}
double tenth(int k) {
  return 0.1 * k;
}
double far_off(int k) {
  return -1e9 + k / 3.0;
}
double one_place(int) {
  return 12.34;
}
double of_all_sizes(int k) {
  return std::ldexp(1.0 + (k % 7) / 7.0, 2 * k);
}

const std::vector<Axis>& axes() {
  static const std::vector<Axis> all{{"whole", whole, 0},
                                     {"whole, a few beside", whole, 0.002},
                                     {"tenth", tenth, 0},
                                     {"tenth, many beside", tenth, 0.3},
                                     {"far off", far_off, 0.1},
                                     {"one place", one_place, 0},
                                     {"one place, beside", one_place, 0.1},
                                     {"of all sizes", of_all_sizes, 0.2}};
  return all;
}

double bound(const Axis& axis, int place, Random& random) {
  const double x = axis.place(place);
  if (!random.chance(axis.beside)) return x;
  return std::nextafter(x, random.chance(0.5) ? 1e300 : -1e300);
}

/// `across` places on each axis, so that most boxes share ends with others, and many are flat.
Boxes<double> lattice(std::size_t n, const Axis* const (&of)[3], int across, Random& random) {
  Boxes<double> boxes(n);
  for (Aabb64& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const int place = random.integer(-across, across);
      const double one = bound(*of[d], place, random), other = bound(*of[d], place + random.integer(0, 1), random);
      box.min[d] = std::min(one, other);
      box.max[d] = std::max(one, other);
    }
  return boxes;
}

/// Every kind of axis beside two others.
template <class Check>
void for_each_kind(const Check& check) {
  const std::size_t count = axes().size();
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t step : {1, 3}) {
      const Axis* const of[3] = {&axes()[i], &axes()[(i + step) % count], &axes()[(i + 2 * step) % count]};
      check(of, of[0]->name + " / " + of[1]->name + " / " + of[2]->name);
    }
}

TEST(LossyKeys, OneSetAndTwo) {
  Checker<double> checker;
  Random random(1);
  for_each_kind([&](const auto& of, const std::string& name) {
    for (const std::size_t n : {2, 40, 160, 384, 385, 700, 2000}) {
      const int across = static_cast<int>(std::cbrt(n)) + 1;
      const auto boxes = lattice(n, of, across, random), others = lattice(n / 2, of, across, random);
      ASSERT_TRUE(checker.one_set(boxes, name, n));
      ASSERT_TRUE(checker.two_sets(boxes, others, name, n));
    }
    for (const std::size_t few : {1, 100, 300}) {
      const auto boxes = lattice(few, of, 12, random), others = lattice(2000, of, 12, random);
      ASSERT_TRUE(checker.two_sets(boxes, others, name, few));
      ASSERT_TRUE(checker.two_sets(others, boxes, name, few));
    }
  });
}

/// With dense hits, and with blocks of which some boxes reach far.
TEST(LossyKeys, ManyPairsAndLongBoxes) {
  Checker<double> checker;
  Random random(2);
  for_each_kind([&](const auto& of, const std::string& name) {
    auto boxes = lattice(1500, of, 4, random);
    ASSERT_TRUE(checker.one_set(boxes, name));
    boxes = lattice(2500, of, 40, random);
    for (std::size_t i = 0; i < boxes.size(); i += 20)
      for (int d = 0; d < 2; ++d) boxes[i].max[d] = bound(*of[d], 45, random);
    boxes.erase(std::remove_if(boxes.begin(), boxes.end(), [](const Aabb64& box) { return !makes_sense(box); }),
                boxes.end());
    ASSERT_TRUE(checker.one_set(boxes, name));
    const auto middle = boxes.begin() + static_cast<std::ptrdiff_t>(boxes.size() / 2);
    ASSERT_TRUE(checker.two_sets({boxes.begin(), middle}, {middle, boxes.end()}, name));
  });
}

TEST(LossyKeys, Streamed) {
  Random random(3);
  Detector detector;
  for_each_kind([&](const auto& of, const std::string& name) {
    const auto boxes = lattice(2000, of, 12, random);
    Pairs all, streamed;
    detector.find_pairs(boxes, all);
    detector.stream_pairs(boxes, [&](Span<const Pair> pairs) {
      streamed.insert(streamed.end(), pairs.begin(), pairs.end());
      return true;
    });
    ASSERT_EQ(streamed, all) << name;
    std::sort(streamed.begin(), streamed.end());
    ASSERT_TRUE(expect_same_pairs(streamed, sweep(boxes), boxes, name, 0));
  });
}

/// Bits that one set loses are no matter to the next.
TEST(LossyKeys, ManySets) {
  Random random(4);
  ManySets<double> sets;
  for_each_kind([&](const auto& of, const std::string&) {
    for (const std::size_t n : {0, 5, 11, 12, 100, 200, 900}) sets.add(lattice(n, of, 6, random), random);
  });
  Detector detector;
  PairsOfSets found;
  detector.find_pairs(sets.boxes, SetOffsets(sets.offsets), found);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    Pairs pairs(found.pairs.begin() + static_cast<std::ptrdiff_t>(found.offsets[i]),
                found.pairs.begin() + static_cast<std::ptrdiff_t>(found.offsets[i + 1]));
    const auto first = static_cast<std::uint32_t>(sets.offsets[i]);
    for (Pair& pair : pairs) pair = {pair.a - first, pair.b - first};
    std::sort(pairs.begin(), pairs.end());
    ASSERT_TRUE(expect_same_pairs(pairs, sweep(sets.set(i)), sets.set(i), "set", i));
  }
}

/// Boxes that are flat by keys may be inside out by all bits.
TEST(LossyKeys, InvalidBoxes) {
  Checker<double> checker;
  Random random(5);
  for_each_kind([&](const auto& of, const std::string& name) {
    auto boxes = lattice(1000, of, 8, random);
    for (std::size_t i = 0; i < boxes.size(); i += 7) {
      const auto d = random.index(3);
      if (random.chance(0.5))
        boxes[i].min[d] = std::nextafter(boxes[i].max[d], INFINITY);
      else
        boxes[i].max[d] = random.chance(0.2) ? NAN : std::nextafter(boxes[i].min[d], -INFINITY);
    }
    ASSERT_TRUE(checker.one_set(boxes, name));
  });
}

/// What is found is right, and it is found without a doubt: on a grid of a power of two no axis loses bits.
TEST(LossyKeys, GridsOfAPowerOfTwoLoseNone) {
  Random random(6);
  for (const double unit : {1.0, 0.125, 1024.0})
    for (const double origin : {0.0, 1000.0, -3e5}) {
      Boxes<double> boxes(500);
      for (Aabb64& box : boxes)
        for (int d = 0; d < 3; ++d) {
          box.min[d] = origin + unit * random.integer(-300, 300);
          box.max[d] = box.min[d] + unit * random.integer(0, 2);
        }
      detail::KeyMap<double> keys;
      keys.fit(boxes);
      detail::Record records[detail::load_block];
      detail::load_records(boxes.data(), detail::load_block, 0, keys, records);
      EXPECT_EQ(keys.lossy().all(), 0u) << unit << ' ' << origin;
    }
}

/// The axes are those of the map, coordinate by coordinate; and no two numbers share a key that loses nothing.
TEST(LossyKeys, AreToldAxisByAxis) {
  Random random(7);
  for_each_kind([&](const auto& of, const std::string& name) {
    const auto boxes = lattice(400, of, 20, random);
    for (const bool is_fitted : {true, false}) {
      detail::KeyMap<double> keys;
      if (is_fitted) keys.fit(boxes);
      std::uint32_t expected = 0;
      for (std::size_t begin = 0; begin < boxes.size(); begin += 50) {
        detail::Record records[detail::load_block];
        detail::load_records(&boxes[begin], 50, 0, keys, records);
        for (std::size_t i = begin; i < begin + 50; ++i)
          for (int d = 0; d < 3; ++d)
            for (const double x : {boxes[i].min[d], boxes[i].max[d]}) {
              if (keys.loses_bits(x, d)) expected |= 1u << d;
              const double above = std::nextafter(x, INFINITY), below = std::nextafter(x, -INFINITY);
              if (keys(above, d) == keys(x, d)) {
                ASSERT_TRUE(keys.loses_bits(x, d) || keys.loses_bits(above, d)) << name << ' ' << x;
              }
              if (keys(below, d) == keys(x, d)) {
                ASSERT_TRUE(keys.loses_bits(x, d) || keys.loses_bits(below, d)) << name << ' ' << x;
              }
            }
        ASSERT_EQ(keys.lossy().all(), expected) << name << ", " << begin;
      }
    }
  });
}

}  // namespace
}  // namespace boxstream::tests
