// SPDX-License-Identifier: MIT
// How much a search compares, by its own counts: of boxes that are made to make it compare too much.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "fast_oracle.hpp"
#include "random.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Work : public testing::Test {
 protected:
  /// Comparisons, and boxes taken into leaves, for n boxes of k pairs must stay below n log2(n)^3 / 2 + 2 k, the order
  /// that the method is proved to have. For 48 000 boxes that is a thirteenth of all with all.
  static void expect_bounded(const Stats& stats, const std::string& name) {
    const double n = static_cast<double>(stats.boxes), log = std::log2(n);
    const double work = static_cast<double>(stats.tests + stats.records);
    const double bound = n * log * log * log / 2 + 2 * static_cast<double>(stats.pairs);
    EXPECT_LE(work, bound) << name << ", " << stats.boxes << " boxes, " << stats.pairs << " pairs";
    testing::Test::RecordProperty(name + "_" + std::to_string(stats.boxes), std::to_string(work / bound));
  }

  Detector detector_;
  Pairs pairs_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Work, Scalars);

/// Combs against plates, which meet on two axes of three; nested boxes; equal low ends; all across the median.
TYPED_TEST(Work, IsBoundedForWorstCasesOfTheMethod) {
  for (const char* name : {"sparse",
                           "comb_and_plates_x",
                           "comb_and_plates_y",
                           "comb_and_plates_z",
                           "spanning_the_median",
                           "slices_x",
                           "slices_y",
                           "slices_z",
                           "rods_x",
                           "rods_y",
                           "rods_z",
                           "rods_mixed",
                           "nested",
                           "equal_low",
                           "identical",
                           "all_overlapping",
                           "layer",
                           "staircase",
                           "clusters",
                           "sphere",
                           "one_step_apart",
                           "touching_lattice"})
    for (const std::size_t n : {700, 3000, 12000, 48000}) {
      const auto& set = box_set<TypeParam>(name);
      if (n > set.largest || (n < 3000 && set.largest > n)) continue;  // of few, all with all is below the bound
      const auto boxes = set.make(n, 1);
      this->expect_bounded(this->detector_.find_pairs(boxes, this->pairs_), name);
    }
}

/// As two sets: every tooth crosses every plate on two axes.
TYPED_TEST(Work, IsBoundedBetweenCombsAndPlates) {
  for (const char* name : {"comb_and_plates_x", "comb_and_plates_y", "comb_and_plates_z"})
    for (const std::size_t n : {3000, 12000, 48000}) {
      Boxes<TypeParam> sides[2];
      const auto all = box_set<TypeParam>(name).make(n, 1);
      for (std::size_t i = 0; i < all.size(); ++i) sides[i % 2].push_back(all[i]);
      this->expect_bounded(this->detector_.find_pairs(sides[0], sides[1], this->pairs_), name);
    }
}

/// Sizes of one to a million: dust, and in it one, ten or a hundred boxes around all of it.
TYPED_TEST(Work, IsBoundedForDustInLargeBoxes) {
  for (const std::size_t n : {3000, 12000, 48000})
    for (const std::size_t large : {1, 10, 100}) {
      Random random(n + large);
      Boxes<TypeParam> boxes;
      while (boxes.size() < n) {
        BasicAabb<TypeParam> box{};
        const bool is_large = boxes.size() % (n / large) == 7;
        for (int d = 0; d < 3; ++d) {
          box.min[d] = is_large ? TypeParam(0) : static_cast<TypeParam>(random.between(0.001, 0.999) * 1e6);
          box.max[d] = is_large ? TypeParam(1e6) : box.min[d] + TypeParam(1);
        }
        boxes.push_back(box);
      }
      const Stats stats = this->detector_.find_pairs(boxes, this->pairs_);
      EXPECT_GE(stats.pairs, large * (n - large));
      this->expect_bounded(stats, "dust_in_" + std::to_string(large));
      if (n == 3000) expect_same_pairs(this->pairs_, brute_force(boxes), boxes, "dust in large boxes", large);
    }
}

/// Which boxes the sample of a node sees decides the plan alone: a hundred orders of the input, so a hundred samples.
TYPED_TEST(Work, NeitherResultNorBoundDependsOnTheSample) {
  Random random(14);
  for (const char* name : {"dense", "rods_mixed", "comb_and_plates_z", "six_decades"}) {
    const auto boxes = box_set<TypeParam>(name).make(3000, 1);
    const Pairs truth = sweep(boxes);
    std::vector<std::uint32_t> order(boxes.size());
    std::iota(order.begin(), order.end(), 0u);
    for (int round = 0; round < 100; ++round) {
      random.shuffle(order);
      Boxes<TypeParam> shuffled;
      for (const std::uint32_t i : order) shuffled.push_back(boxes[i]);
      const Stats stats = this->detector_.find_pairs(shuffled, this->pairs_);
      this->expect_bounded(stats, name);
      for (Pair& pair : this->pairs_) {
        pair = {order[pair.a], order[pair.b]};
        if (pair.b < pair.a) std::swap(pair.a, pair.b);
      }
      ASSERT_TRUE(expect_same_pairs(this->pairs_, truth, boxes, name, static_cast<std::uint64_t>(round)));
    }
  }
}

/// Orders that are known to spoil sorting. What is compared may not depend on them by more than a plan's luck.
TYPED_TEST(Work, IsBoundedForEveryOrderOfTheInput) {
  for (const char* name : {"sparse", "clusters", "two_far_groups", "ties"}) {
    const auto& set = box_set<TypeParam>(name);
    const std::size_t n = std::min<std::size_t>(20000, set.largest);
    auto sorted = set.make(n, 1);
    for (int axis = 0; axis < 3; ++axis) {
      std::sort(sorted.begin(), sorted.end(), [&](const auto& x, const auto& y) { return x.min[axis] < y.min[axis]; });
      auto orders = std::vector<Boxes<TypeParam>>(5, sorted);
      std::reverse(orders[1].begin(), orders[1].end());
      for (std::size_t i = 0; i < n; ++i) {
        orders[2][i % 2 == 0 ? i / 2 : n - 1 - i / 2] = sorted[i];        // up and down again
        orders[3][i] = sorted[i % 2 == 0 ? i / 2 : (n + 1) / 2 + i / 2];  // two runs shuffled into one
        orders[4][i] = sorted[(i * 64 + i / (n / 64 + 1)) % n];           // in strides (some twice)
      }
      for (const auto& boxes : orders) this->expect_bounded(this->detector_.find_pairs(boxes, this->pairs_), name);
    }
  }
}

}  // namespace
}  // namespace boxstream::tests
