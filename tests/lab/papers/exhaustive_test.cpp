// SPDX-License-Identifier: MIT
// All configurations of a few boxes on a grid of four values: every way in which half-open intervals can meet, and
// every tie. Hybrid with a cutoff of 0 streams down to single boxes.
#include <gtest/gtest.h>

#include "random.hpp"
#include "sanitized.hpp"
#include "truth.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;

constexpr Interval intervals[] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};

HybridOptions cutoff(std::size_t boxes) {
  HybridOptions options;
  options.cutoffs = Cutoffs(boxes);
  return options;
}

/// `count` boxes; which ones is the number `code` in base 6, one digit an axis in [first, last].
std::vector<Box> decode(std::size_t code, int count, int first, int last) {
  std::vector<Box> boxes(static_cast<std::size_t>(count), {{{0, 3}, {0, 3}, {0, 3}}});
  for (Box& box : boxes)
    for (int d = first; d <= last; ++d, code /= 6) box.projections[d] = intervals[code % 6];
  return boxes;
}

std::size_t configurations(int digits) {
  std::size_t count = 1;
  while (digits-- > 0) count *= 6;
  return count;
}

bool check_splits(const std::vector<Box>& boxes, const HybridOptions& options, const std::string& what) {
  for (std::size_t in_a = 0; in_a <= boxes.size(); ++in_a) {
    const auto middle = boxes.begin() + static_cast<std::ptrdiff_t>(in_a);
    if (!check_all({boxes.begin(), middle}, {middle, boxes.end()}, options, what)) return false;
  }
  return check_all(boxes, options, what);
}

/// Of all configurations, or a sample of them.
constexpr std::size_t stride = boxstream::tests::sanitized ? 7 : 1;

TEST(ProceduresExhaustive, OneAxisFourBoxes) {
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t code = 0; code < configurations(4); code += stride)
      for (const std::size_t c : {0u, 3u})
        ASSERT_TRUE(check_splits(decode(code, 4, axis, axis), cutoff(c), "one axis"));
}

TEST(ProceduresExhaustive, TwoAxesTwoBoxes) {
  for (int first = 0; first < 2; ++first)
    for (std::size_t code = 0; code < configurations(4); ++code)
      ASSERT_TRUE(check_splits(decode(code, 2, first, first + 1), cutoff(0), "two axes"));
}

TEST(ProceduresExhaustive, ThreeAxesTwoBoxes) {
  for (std::size_t code = 0; code < configurations(6); code += stride) {
    const auto boxes = decode(code, 2, 0, 2);
    ASSERT_TRUE(check_all(boxes, cutoff(0), "three axes"));
    ASSERT_TRUE(check_all({boxes[0]}, {boxes[1]}, cutoff(0), "three axes, two sets"));
  }
}

/// A sample: there are 10^7 configurations of three boxes, and 5 * 10^11 of five.
TEST(ProceduresExhaustive, ThreeAxesThreeToFiveBoxesSampled) {
  Random random(1);
  for (int round = 0; round < (boxstream::tests::sanitized ? 400 : 4000); ++round)
    for (int n = 3; n <= 5; ++n) {
      std::vector<Box> boxes;
      for (int i = 0; i < n; ++i) boxes.push_back(decode(random.index(216), 1, 0, 2)[0]);
      HybridOptions options = cutoff(random.index(4));
      options.seed = static_cast<std::uint64_t>(round);
      ASSERT_TRUE(check_splits(boxes, options, "three axes, sampled, round " + std::to_string(round)));
    }
}

}  // namespace
}  // namespace boxstream::papers::tests
