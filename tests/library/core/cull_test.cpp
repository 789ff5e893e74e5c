// SPDX-License-Identifier: MIT
// Two large sets, parts of which are where the other is not: what is left out before they are partitioned.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/arena.hpp"
#include "batch/cuts/cull.hpp"
#include "batch/cuts/occupancy.hpp"
#include "box_sets.hpp"
#include "checks.hpp"
#include "executors.hpp"
#include "random.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

using detail::BoxColumns;
using detail::CellColumns;
using detail::CellGrid;

/// Keys evenly spaced, so that cells are known.
CellGrid linear_grid(unsigned cells) {
  CellGrid grid{{}, cells};
  for (int d = 0; d < 3; ++d) {
    const unsigned count = d == 0 ? CellGrid::cells_in_x : cells;
    grid.axes[d] = {detail::KeyKind::linear, 0, 999'999, 0, 999'999, count};
  }
  return grid;
}

/// Most of them in few rows, so that many share one.
BoxColumns random_block(Random& random, double longest) {
  BoxColumns block;
  for (std::size_t i = 0; i < detail::load_block; ++i)
    for (int d = 0; d < 3; ++d) {
      const double lo = random.chance(0.2) ? random.between(-300'000, 1'300'000) : random.between(450'000, 550'000);
      const double size = random.chance(0.03) ? 3'000'000 : longest;
      block.lo[d][i] = static_cast<std::int32_t>(lo);
      block.hi[d][i] = static_cast<std::int32_t>(lo + random.unit() * size);
    }
  return block;
}

/// Whether both boxes touch one cell.
bool share_cell(const CellColumns& a, std::size_t i, const CellColumns& b, std::size_t j) {
  for (int d = 0; d < 3; ++d)
    if (a.first[d][i] > b.last[d][j] || b.first[d][j] > a.last[d][i]) return false;
  return true;
}

bool is_everywhere(const CellColumns& boxes, std::size_t i, unsigned cells) {
  const int rows = (boxes.last[1][i] - boxes.first[1][i] + 1) * (boxes.last[2][i] - boxes.first[2][i] + 1);
  return rows > 2 * static_cast<int>(cells);
}

/// Boxes that share a cell with a marked one, and no others but for those that are taken to be everywhere.
TEST(Occupancy, TellsWhichBoxesShareACell) {
  Random random(1);
  for (const unsigned cells : {32u, 64u, 128u, 256u})
    for (const double longest : {1'000.0, 20'000.0, 60'000.0, 400'000.0}) {
      const CellGrid grid = linear_grid(cells);
      detail::Arena arena;
      detail::Occupancy occupancy(cells, arena);
      const BoxColumns marked_boxes = random_block(random, longest);
      CellColumns marked, asked;
      locate_cells(marked_boxes, grid, marked);
      const std::uint64_t which = 0x1200450009000005u;  // few, or one would hide what another does not
      occupancy.mark(marked, which);
      occupancy.finish();
      for (int round = 0; round < 20; ++round) {
        locate_cells(random_block(random, longest), grid, asked);
        const std::uint64_t found = occupancy.may_meet(asked);
        for (std::size_t i = 0; i < detail::load_block; ++i) {
          bool expected = is_everywhere(asked, i, cells);
          for (std::size_t j = 0; j < detail::load_block; ++j) {
            if ((which >> j & 1) == 0) continue;
            const bool in_x = asked.first[0][i] <= marked.last[0][j] && marked.first[0][j] <= asked.last[0][i];
            expected |= is_everywhere(marked, j, cells) ? in_x : share_cell(asked, i, marked, j);
          }
          ASSERT_EQ((found >> i & 1) != 0, expected) << cells << " cells, sides up to " << longest << ", box " << i;
        }
      }
    }
}

/// What lies beyond the range of a grid is in cells of its own.
TEST(Occupancy, CellsBeyondTheRange) {
  const std::int32_t keys[] = {INT32_MIN, -1, 0, 999'999, 1'000'000, INT32_MAX};
  BoxColumns block{};
  for (int d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < std::size(keys); ++i) block.lo[d][i] = block.hi[d][i] = keys[i];
  CellColumns cells;
  locate_cells(block, linear_grid(64), cells);
  const unsigned expected[] = {0, 0, 1, 62, 63, 63};
  for (int d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < std::size(keys); ++i) EXPECT_EQ(cells.first[d][i], expected[i]) << keys[i];
}

/// Cells follow the order of numbers, whatever the range: from the least number to the largest, or none.
TEST(Occupancy, CellsOfFloatsAreInOrder) {
  constexpr float largest = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
  std::vector<float> numbers = {0, least, 3 * least, 1e-38f, 1e-30f, 1, 1 + 1e-7f, 1.5f, 2, 1e20f, 9e37f, largest};
  for (std::size_t i = 0, n = numbers.size(); i < n; ++i) numbers.push_back(-numbers[i]);
  std::sort(numbers.begin(), numbers.end());
  BoxColumns block{};
  for (int d = 0; d < 3; ++d)
    for (std::size_t i = 0; i < numbers.size(); ++i) block.lo[d][i] = block.hi[d][i] = detail::order_key(numbers[i]);
  for (const float from : numbers)
    for (const float to : numbers) {
      if (to < from) continue;
      CellGrid grid{{}, 64};
      const std::int32_t first = detail::order_key(from), last = detail::order_key(to);
      for (auto& axis : grid.axes) axis = {detail::KeyKind::float32, first, last, first, last, 64};
      CellColumns cells;
      locate_cells(block, grid, cells);
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        const unsigned cell = cells.first[1][i];
        EXPECT_EQ(cell == 0, numbers[i] < from) << numbers[i] << " from " << from << " to " << to;
        EXPECT_EQ(cell == 63, numbers[i] > to) << numbers[i] << " from " << from << " to " << to;
        EXPECT_LE(cell, 63u);
        EXPECT_TRUE(i == 0 || cells.first[1][i - 1] <= cell) << numbers[i] << " from " << from << " to " << to;
      }
    }
}

/// The surface of a sphere.
template <class S>
Boxes<S> shell(std::size_t n, double x, std::uint64_t seed) {
  Random random(seed);
  Boxes<S> boxes;
  while (boxes.size() < n) {
    double p[3], length = 0;
    for (double& coordinate : p) {
      coordinate = random.between(-1, 1);
      length += coordinate * coordinate;
    }
    if (length > 1 || length < 0.01) continue;
    BasicAabb<S> box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<S>(100 * (p[d] / std::sqrt(length) + (d == 0 ? x : 0)));
      box.max[d] = box.min[d] + static_cast<S>(random.unit());
    }
    boxes.push_back(box);
  }
  return boxes;
}

/// All over a cube, with about one pair for two boxes.
template <class S>
Boxes<S> uniform_boxes(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const double side = std::cbrt(0.125 / static_cast<double>(n));
  Boxes<S> boxes(n);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<S>(random.unit());
      box.max[d] = box.min[d] + static_cast<S>(side * 2 * random.unit());
    }
  return boxes;
}

/// A box in a thousand is a plane, a rod, a half-space, a point at infinity, inverted or has a NaN.
template <class S>
void add_strange_ones(Boxes<S>& boxes, std::uint64_t seed) {
  constexpr S infinity = std::numeric_limits<S>::infinity(), nan = std::numeric_limits<S>::quiet_NaN();
  Random random(seed);
  for (std::size_t i = 0; i < boxes.size(); i += 1 + random.index(6000)) {
    BasicAabb<S>& box = boxes[i];
    const std::size_t axis = random.index(3), other = (axis + 1) % 3;
    switch (random.index(6)) {
      case 0:
        box.min[axis] = -infinity;
        box.max[axis] = infinity;
        break;
      case 1:
        box.min[axis] = box.min[other] = S(-1e18);
        box.max[axis] = box.max[other] = S(1e18);
        break;
      case 2:
        box.max[axis] = infinity;
        break;
      case 3:
        box.min[axis] = box.max[axis] = infinity;
        break;
      case 4:
        box.min[axis] = box.max[axis] + 1;
        break;
      default:
        box.max[axis] = nan;
    }
  }
}

template <class S>
class Cull : public testing::Test {
 protected:
  void expect_culled(const Boxes<S>& a, const Boxes<S>& b, const char* scene) {
    const Pairs expected = sweep(a, b);
    ASSERT_TRUE(check_.two_sets(a, b, expected, scene));
    const Stats stats = check_.detector().find_pairs(a, b, pairs_);
    EXPECT_LT(stats.records, stats.boxes / 2) << scene;
    Pairs turned;
    for (const Pair pair : expected) turned.push_back({pair.b, pair.a});
    std::sort(turned.begin(), turned.end());
    ASSERT_TRUE(check_.two_sets(b, a, turned, scene));
  }

  /// Compares what filters leave of all pairs with what a search with filters finds, on any number of threads.
  template <class FilterOf>
  Stats expect_accepted(const Boxes<S>& boxes, const FilterOf& filter_of) {
    Filters filters;
    for (std::size_t i = 0; i < boxes.size(); ++i) filters.push_back(filter_of(i));
    Pairs all, found, again;
    check_.detector().find_pairs(boxes, all);
    std::erase_if(all, [&](Pair pair) { return !permitted(filters, pair.a, filters, pair.b); });
    const Stats stats = check_.detector().find_pairs(boxes, found, filters);
    ThreadExecutor executor(3);
    Detector(DetectorOptions{&executor}).find_pairs(boxes, again, filters);
    EXPECT_EQ(found, again);
    std::sort(all.begin(), all.end());
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, all);
    return stats;
  }

  Checker<S> check_;
  Pairs pairs_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Cull, Scalars);

TYPED_TEST(Cull, SurfacesThatCross) {
  auto a = shell<TypeParam>(100000, 0, 1), b = shell<TypeParam>(100000, 1, 2);
  this->expect_culled(a, b, "shells");
  add_strange_ones(a, 3);
  add_strange_ones(b, 4);
  Pairs pairs;
  this->check_.two_sets(a, b, sweep(a, b), "shells with strange ones");
}

TYPED_TEST(Cull, SetsBesideEachOther) {
  this->expect_culled(shell<TypeParam>(100000, 0, 1), shell<TypeParam>(100000, 1.9, 2), "that hardly meet");
  this->expect_culled(shell<TypeParam>(100000, 0, 1), shell<TypeParam>(100000, 3, 2), "that do not meet");
}

/// Faces of two lattices in one plane, so that all that touch touch at a coordinate where one set ends.
TYPED_TEST(Cull, SetsThatTouch) {
  Boxes<TypeParam> a, b;
  for (int i = 0; i < 100000; ++i) {
    const auto x = static_cast<TypeParam>(i % 10), y = static_cast<TypeParam>(i / 10 % 100),
               z = static_cast<TypeParam>(i / 1000);
    a.push_back({{x, y, z}, {x + 1, y + TypeParam(0.5), z + TypeParam(0.5)}});
    b.push_back({{x + 10, y, z}, {x + 11, y + TypeParam(0.5), z + TypeParam(0.5)}});
  }
  Random random(1);
  random.shuffle(a);
  random.shuffle(b);
  this->expect_culled(a, b, "lattices");
  EXPECT_EQ(this->pairs_.size(), 10000u);
}

TYPED_TEST(Cull, SmallSetInALargeOne) {
  for (const std::size_t few : {200, 1000, 5000}) {
    auto a = shell<TypeParam>(few, 0.5, few), b = shell<TypeParam>(110000, 0, 2);
    this->expect_culled(a, b, "small and large");
    add_strange_ones(b, 5);
    this->check_.two_sets(a, b, sweep(a, b), "small and large with strange ones");
  }
}

/// A tenth moves, and what stands still meets that alone: most of it is not looked at twice.
TYPED_TEST(Cull, FewAmongStaticOnes) {
  for (const std::size_t n : {3000, 40000}) {
    auto boxes = uniform_boxes<TypeParam>(n, n);
    const auto filter = [](std::size_t i) { return i % 10 == 0 ? Filter{1, 3} : Filter{2, 1}; };
    EXPECT_LT(this->expect_accepted(boxes, filter).records, n * 3 / 4) << n;
    add_strange_ones(boxes, 7);
    const std::uint64_t invalid = this->check_.detector().find_pairs(boxes, this->pairs_).invalid;
    EXPECT_EQ(this->expect_accepted(boxes, filter).invalid, invalid) << n;
  }
}

/// Two kinds that move refuse each other, one meets what the other does not, a third that meets what stands refuses
/// itself, and some meet nothing at all.
TYPED_TEST(Cull, SeveralKindsAmongStaticOnes) {
  auto boxes = uniform_boxes<TypeParam>(20000, 5);
  const auto filter = [](std::size_t i) {
    if (i % 20 < 2) return i % 20 == 0 ? Filter{1, 1 | 4 | 8} : Filter{2, 2 | 4};
    if (i % 20 < 5) return i % 20 == 2 ? Filter{32, 4} : Filter{16, 0};
    return i % 2 == 0 ? Filter{4, 1 | 2 | 32} : Filter{8, 1};
  };
  EXPECT_LT(this->expect_accepted(boxes, filter).records, boxes.size() * 3 / 4);
  add_strange_ones(boxes, 7);
  const std::uint64_t invalid = this->check_.detector().find_pairs(boxes, this->pairs_).invalid;
  EXPECT_EQ(this->expect_accepted(boxes, filter).invalid, invalid);
}

/// Nothing is gained where both sets are everywhere: then nothing is left out either.
TYPED_TEST(Cull, SetsInOnePlaceAreJoinedAsTheyAre) {
  const auto a = shell<TypeParam>(100000, 0, 1), b = shell<TypeParam>(100000, 0, 2);
  Pairs pairs;
  const Stats stats = this->check_.detector().find_pairs(a, b, pairs);
  EXPECT_GE(stats.records, stats.boxes);
  const detail::KeyMap<TypeParam> keys;
  const detail::KeyKind kinds[] = {keys.kind(0), keys.kind(1), keys.kind(2)};
  detail::Arena arena;
  EXPECT_FALSE(detail::cull(detail::BoxSource<TypeParam>(a, keys), detail::BoxSource<TypeParam>(b, keys), kinds, arena)
                   .worthwhile);
}

TYPED_TEST(Cull, FiltersSinkAndThreads) {
  auto a = shell<TypeParam>(100000, 0, 1), b = shell<TypeParam>(100000, 1, 2);
  add_strange_ones(a, 3);
  add_strange_ones(b, 4);
  Filters fa(a.size()), fb(b.size());
  for (std::size_t i = 0; i < fa.size(); ++i) fa[i] = {1u << i % 3, static_cast<std::uint32_t>(i % 7)};
  for (std::size_t i = 0; i < fb.size(); ++i) fb[i] = {1u << i % 3, static_cast<std::uint32_t>(i % 5 + 3)};
  Pairs all, accepted, found;
  this->check_.detector().find_pairs(a, b, all);
  for (const Pair pair : all)
    if (permitted(fa, pair.a, fb, pair.b)) accepted.push_back(pair);
  EXPECT_LT(accepted.size(), all.size());
  for (const unsigned threads : {1u, 2u, 5u}) {
    ThreadExecutor executor(threads);
    Detector detector(DetectorOptions{&executor});
    detector.find_pairs(a, b, found);
    EXPECT_EQ(found, all) << threads << " threads";
    detector.find_pairs(a, b, found, fa, fb);
    EXPECT_EQ(found, accepted) << threads << " threads, filtered";
    found.clear();
    detector.stream_pairs(a, b, [&](Span<const Pair> pairs) {
      found.insert(found.end(), pairs.begin(), pairs.end());
      return found.size() < all.size() / 2;
    });
    ASSERT_LT(found.size(), all.size());
    EXPECT_TRUE(std::equal(found.begin(), found.end(), all.begin())) << threads << " threads, stopped";
  }
}

}  // namespace
}  // namespace boxstream::tests
