// SPDX-License-Identifier: MIT
// Closed boxes of real numbers through rank mapping, against brute force on the numbers themselves and the engine.
#include "papers/hybrid/ranks.hpp"

#include <gtest/gtest.h>
#include <boxstream/detector.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "inputs/batches.hpp"
#include "oracle.hpp"
#include "random.hpp"
#include "truth.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::brute_force;
using boxstream::tests::Random;
template <class S>
using Boxes = std::vector<BasicAabb<S>>;

template <class S>
void check(const Boxes<S>& boxes, const std::string& what) {
  const Pairs expected = brute_force(boxes);
  Pairs engine = find_pairs(Span<const BasicAabb<S>>(boxes));
  EXPECT_TRUE(same_pairs(engine, expected, what + ", the engine"));
  HybridOptions options;
  options.cutoffs = Cutoffs(8);
  const std::vector<Box> ranked = ranks(Span<const BasicAabb<S>>(boxes));
  for (const Procedure procedure : procedures())
    EXPECT_TRUE(same_pairs(collect([&](auto&& found) { run(procedure, Span<const Box>(ranked), options, found); }),
                           expected, what + ", " + std::string(name(procedure))));
}

template <class S>
void check(const Boxes<S>& a, const Boxes<S>& b, const std::string& what) {
  const Pairs expected = brute_force(a, b);
  HybridOptions options;
  options.cutoffs = Cutoffs(8);
  const TwoSets ranked = ranks(Span<const BasicAabb<S>>(a), Span<const BasicAabb<S>>(b));
  for (const Procedure procedure : procedures())
    EXPECT_TRUE(same_pairs(collect([&](auto&& found) {
                             run(procedure, Span<const Box>(ranked.a), Span<const Box>(ranked.b), options, found);
                           }),
                           expected, what + ", " + std::string(name(procedure)) + ", two sets"));
}

TEST(Ranks, EveryBatch) {
  for (const batches::Batch& batch : batches::all()) {
    const std::string what(batch.name);
    check(batches::make(batch.name, 400, 1), what + " float");
    check(batches::make64(batch.name, 400, 2), what + " double");
    check(batches::make(batch.name, 150, 3), batches::make(batch.name, 250, 4), what + " float");
    check(batches::make64(batch.name, 250, 5), batches::make64(batch.name, 150, 6), what + " double");
  }
}

/// Ends that are equal, one step apart, of both zeros, denormal and infinite, and boxes without extent.
template <class S>
Boxes<S> hard_boxes(std::size_t n, std::uint64_t seed) {
  using Limits = std::numeric_limits<S>;
  const S values[] = {-Limits::infinity(),
                      Limits::lowest(),
                      S(-1),
                      -Limits::denorm_min(),
                      S(-0.0),
                      S(0.0),
                      Limits::denorm_min(),
                      S(1),
                      std::nextafter(S(1), S(2)),
                      Limits::max(),
                      Limits::infinity()};
  Random random(seed);
  Boxes<S> boxes(n);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const S a = values[random.index(std::size(values))], b = values[random.index(std::size(values))];
      box.min[d] = a < b ? a : b;
      box.max[d] = a < b ? b : a;
    }
  return boxes;
}

TEST(Ranks, HardNumbers) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    check(hard_boxes<float>(200, seed), "hard float, seed " + std::to_string(seed));
    check(hard_boxes<double>(200, seed), "hard double, seed " + std::to_string(seed));
    check(hard_boxes<double>(90, seed), hard_boxes<double>(110, seed + 100), "hard, seed " + std::to_string(seed));
  }
}

TEST(Ranks, AreAPermutationOfPlaces) {
  const auto ranked = ranks(Span<const Aabb>(batches::make("T", 100, 1)));
  for (int d = 0; d < 3; ++d) {
    std::vector<std::int32_t> all;
    for (const Box& box : ranked) {
      EXPECT_LT(box.projections[d].lo, box.projections[d].hi);
      all.push_back(box.projections[d].lo);
      all.push_back(box.projections[d].hi);
    }
    std::sort(all.begin(), all.end());
    for (std::int32_t i = 0; i < 200; ++i) EXPECT_EQ(all[static_cast<std::size_t>(i)], i);
  }
}

TEST(Ranks, RefuseInvalidBoxes) {
  Boxes<float> boxes(3, {{0, 0, 0}, {1, 1, 1}});
  boxes[1].max[2] = -1;
  EXPECT_THROW(ranks(Span<const Aabb>(boxes)), std::invalid_argument);
  boxes[1].max[2] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(ranks(Span<const Aabb>(boxes)), std::invalid_argument);
}

}  // namespace
}  // namespace boxstream::papers::tests
