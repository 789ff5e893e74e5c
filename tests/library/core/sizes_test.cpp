// SPDX-License-Identifier: MIT
// Sizes around SIMD widths, powers of two and likely cutoffs, for every box set.
#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "checks.hpp"
#include "random.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Sizes : public testing::Test {
 protected:
  Checker<S> checker_;

  /// One set of n, and two sets: n against n, many against few, few against many.
  bool check(const BoxSet<S>& set, std::size_t n, std::uint64_t seed) {
    return check_one(set, n, seed) && check_two(set, n, n, seed) && check_two(set, n, n / 8 + 1, seed) &&
           check_two(set, n / 8 + 1, n, seed);
  }

  /// The same, but of the searches in two sets only one, by turns.
  bool check_briefly(const BoxSet<S>& set, std::size_t n, std::uint64_t seed) {
    const std::size_t few = n / 8 + 1;
    return check_one(set, n, seed) && check_two(set, n % 3 == 0 ? few : n, n % 3 == 1 ? few : n, seed);
  }

 private:
  bool check_one(const BoxSet<S>& set, std::size_t n, std::uint64_t seed) {
    return checker_.one_set(set.make(n, seed), set.name, seed);
  }

  bool check_two(const BoxSet<S>& set, std::size_t n, std::size_t m, std::uint64_t seed) {
    return checker_.two_sets(set.make(n, seed), set.make(m, seed + 1000), set.name, seed);
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Sizes, Scalars);

TYPED_TEST(Sizes, AllUpTo130) {
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    for (std::size_t n = 0; n <= 130; ++n) ASSERT_TRUE(this->check(set, n, n));
}

TYPED_TEST(Sizes, AroundPowersOfTwo) {
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    for (std::size_t power = 256; power <= 2048; power *= 2)
      for (const std::size_t n : {power - 1, power, power + 1})
        if (n <= set.largest) {
          ASSERT_TRUE(this->check_briefly(set, n, n));
        }
}

TYPED_TEST(Sizes, FiveThousand) {
  for (const auto& set : box_sets_to_repeat<TypeParam>())
    if (set.largest >= 5000) {
      ASSERT_TRUE(this->check_briefly(set, 5000, 50));
    }
}

TYPED_TEST(Sizes, EveryOneInWindows) {
  const std::size_t windows[][2] = {{131, 330}, {500, 520}, {1000, 1010}};
  for (const char* name : {"dense", "touching_lattice", "slices_y", "rods_mixed", "comb_and_plates_z"})
    for (const auto& window : windows)
      for (std::size_t n = window[0]; n <= window[1]; ++n)
        ASSERT_TRUE(this->check_briefly(box_set<TypeParam>(name), n, n));
}

/// A view may start anywhere: vector loads must not rely on its alignment, nor read past its end (for sanitizers).
TYPED_TEST(Sizes, FromAnyStart) {
  for (const char* name : {"dense", "ties"})
    for (const std::size_t n : {3, 15, 16, 17, 33, 500}) {
      const Boxes<TypeParam> all = box_set<TypeParam>(name).make(n + 9, n);
      for (std::size_t start = 0; start <= 9; ++start) {
        const Boxes<TypeParam> part(all.begin() + static_cast<std::ptrdiff_t>(start),
                                    all.begin() + static_cast<std::ptrdiff_t>(start + n));
        Pairs found;
        this->checker_.detector().find_pairs(Span<const BasicAabb<TypeParam>>(all).subspan(start, n), found);
        ASSERT_TRUE(expect_same_pairs(found, brute_force(part), part, name, n));
      }
    }
}

/// Big, small, empty, big: what a large search leaves in the scratch must not show up in a small one.
TYPED_TEST(Sizes, ShrinkAndGrowOneDetector) {
  for (const std::size_t n : {3000, 17, 0, 1, 700, 2, 4000, 130})
    for (const char* name : {"dense", "rods_mixed", "slices_x"})
      ASSERT_TRUE(this->check(box_set<TypeParam>(name), n, n));
}

TYPED_TEST(Sizes, OneSetIsEmpty) {
  const auto boxes = box_set<TypeParam>("dense").make(3000, 1);
  EXPECT_TRUE(this->checker_.two_sets(boxes, {}, "dense against none"));
  EXPECT_TRUE(this->checker_.two_sets({}, boxes, "none against dense"));
  EXPECT_TRUE(this->checker_.two_sets({}, {}, "none against none"));
}

/// The same set on both sides: each box meets itself, and each pair comes in both orders.
TYPED_TEST(Sizes, OneSetAgainstItself) {
  for (const std::size_t n : {1, 5, 64, 300, 3000}) {
    const auto boxes = box_set<TypeParam>("dense").make(n, n);
    EXPECT_TRUE(this->checker_.two_sets(boxes, boxes, "dense against itself"));
    const auto within = brute_force(boxes).size();
    EXPECT_EQ(this->checker_.found().size(), 2 * within + n);
  }
}

/// Blocks of a sweep in which a few boxes reach much farther than the others do, and go on alone.
TYPED_TEST(Sizes, AFewLongBoxesAgainstManyShortOnes) {
  using S = TypeParam;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Random random(seed);
    const auto make = [&](std::size_t n, std::size_t long_ones) {
      Boxes<S> boxes(n);
      for (std::size_t i = 0; i < n; ++i) {
        const double sides[] = {long_ones != 0 && i % long_ones == 0 ? 90.0 : 4.0, 0.6, 0.6};
        for (int d = 0; d < 3; ++d) {
          boxes[i].min[d] = static_cast<S>(random.between(0, d == 0 ? 100 : 1));
          boxes[i].max[d] = boxes[i].min[d] + static_cast<S>(random.between(0, sides[d]));
        }
      }
      return boxes;
    };
    const auto few_long = make(220 + 10 * seed, 12), short_ones = make(600, 0);
    ASSERT_TRUE(this->checker_.two_sets(few_long, short_ones, "long against short"));
    ASSERT_TRUE(this->checker_.two_sets(short_ones, few_long, "short against long"));
  }
}

TYPED_TEST(Sizes, OneOffCallsFindTheSame) {
  const auto a = box_set<TypeParam>("dense").make(800, 1), b = box_set<TypeParam>("dense").make(90, 2);
  using View = Span<const BasicAabb<TypeParam>>;
  expect_same_pairs(find_pairs(View(a)), brute_force(a), a, "dense", 1);
  expect_same_pairs(find_pairs(View(a), View(b)), brute_force(a, b), a, b, "dense", 1);
}

}  // namespace
}  // namespace boxstream::tests
