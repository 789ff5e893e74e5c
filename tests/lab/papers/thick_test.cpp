// SPDX-License-Identifier: MIT
// The algorithm for thick objects with predicates of many kinds, and what it allocates. A program of its own, because
// it counts allocations.
#include "papers/thick/report_intersections.hpp"

#include <gtest/gtest.h>

#include "heap_watch.hpp"
#include "random.hpp"
#include "truth.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;
namespace heap_watch = boxstream::tests::heap_watch;

/// A cube, which is thick, with any point in it for a reference point. Whole numbers, so that all of it is exact and
/// coordinates are often equal.
template <std::size_t D>
struct Cube {
  std::array<double, D> low, reference;
  double edge;
};

template <std::size_t D>
bool meet(const Cube<D>& a, const Cube<D>& b) {
  for (std::size_t d = 0; d < D; ++d)
    if (a.low[d] > b.low[d] + b.edge || b.low[d] > a.low[d] + a.edge) return false;
  return true;
}

enum class Layout { scattered, on_a_line, in_one_place, across_only };

template <std::size_t D>
std::vector<Cube<D>> cubes(std::size_t n, Random& random, int range, int smallest, int largest, Layout layout) {
  std::vector<Cube<D>> all(n);
  for (Cube<D>& cube : all) {
    cube.edge = random.integer(smallest, largest);
    const double along = random.integer(0, range);
    for (std::size_t d = 0; d < D; ++d) {
      const bool flat = layout == Layout::in_one_place || (layout == Layout::across_only && d + 1 < D);
      cube.low[d] = flat ? 0 : layout == Layout::on_a_line ? along : random.integer(0, range);
      cube.reference[d] = cube.low[d] + random.integer(0, static_cast<int>(cube.edge));
    }
  }
  return all;
}

template <std::size_t D>
Pairs pairs_of(const std::vector<Cube<D>>& cubes, double edge, Pivot pivot) {
  return collect([&](auto&& found) {
    // The longest side stands for the diameter: all that the algorithm takes from it is how far coordinates differ.
    report_intersections<D>(
        Span<const Cube<D>>(cubes), edge, [](const Cube<D>& cube, std::size_t d) { return cube.reference[d]; }, meet<D>,
        found, pivot);
  });
}

template <std::size_t D>
Pairs brute_force(const std::vector<Cube<D>>& cubes) {
  Pairs pairs;
  for (std::uint32_t i = 0; i < cubes.size(); ++i)
    for (std::uint32_t j = i + 1; j < cubes.size(); ++j)
      if (meet(cubes[i], cubes[j])) pairs.push_back({i, j});
  return pairs;
}

template <std::size_t D>
void check_cubes() {
  for (int seed = 1; seed <= 120; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    const auto n = random.index(seed % 10 == 0 ? 250 : 60);
    const int range = random.integer(0, 1) == 0 ? random.integer(0, 12) : random.integer(100, 2000);
    const int largest = random.integer(0, 12), smallest = random.chance(0.5) ? largest : random.integer(0, largest);
    const auto layout = static_cast<Layout>(random.integer(0, 3));
    const auto set = cubes<D>(n, random, range, smallest, largest, layout);
    const Pairs expected = brute_force(set);
    for (const Pivot pivot : {Pivot::median, Pivot::random})
      ASSERT_TRUE(same_pairs(pairs_of<D>(set, largest, pivot), expected,
                             "D " + std::to_string(D) + ", seed " + std::to_string(seed)));
  }
}

TEST(Thick, CubesInOneDimension) {
  check_cubes<1>();
}
TEST(Thick, CubesInTwoDimensions) {
  check_cubes<2>();
}
TEST(Thick, CubesInThreeDimensions) {
  check_cubes<3>();
}
TEST(Thick, CubesInFourDimensions) {
  check_cubes<4>();
}

/// A generalised predicate (section 2.1) need not be geometry: here closeness and the same colour.
TEST(Thick, AnyPredicateOfTheCallers) {
  struct Dot {
    float x, y;
    int colour;
  };
  Random random(7);
  std::vector<Dot> dots(500);
  for (Dot& dot : dots)
    dot = {static_cast<float>(random.between(0, 10)), static_cast<float>(random.between(0, 10)), random.integer(0, 2)};
  const auto related = [](const Dot& a, const Dot& b) {
    return a.colour == b.colour && std::abs(a.x - b.x) <= 0.5F && std::abs(a.y - b.y) <= 0.5F;
  };
  Pairs expected;
  for (std::uint32_t i = 0; i < dots.size(); ++i)
    for (std::uint32_t j = i + 1; j < dots.size(); ++j)
      if (related(dots[i], dots[j])) expected.push_back({i, j});
  ASSERT_GT(expected.size(), 100u);
  const auto found = collect([&](auto&& sink) {
    // A little more than 0.5, because a difference that is rounded to 0.5 can be more.
    report_within_reach<2>(
        Span<const Dot>(dots), 0.501F, [](const Dot& dot, std::size_t d) { return d == 0 ? dot.x : dot.y; }, related,
        sink);
  });
  EXPECT_TRUE(same_pairs(found, expected, "dots"));
}

/// Rounding of the bounds of slabs must lose no pair: steps of one ulp of numbers that are large beside the reach.
TEST(Thick, SlabsFinerThanOneUlp) {
  using Point = std::array<float, 2>;
  Random random(8);
  for (int round = 0; round < 50; ++round) {
    std::vector<Point> points(200);
    const float reach = round % 2 == 0 ? 0.3F : 2.5F;  // an ulp here is 1
    for (Point& p : points)
      p = {static_cast<float>((1 << 23) + random.integer(0, 40)),
           static_cast<float>((1 << 23) + random.integer(0, 40))};
    const auto near = [&](const Point& a, const Point& b) {
      return std::abs(a[0] - b[0]) <= reach && std::abs(a[1] - b[1]) <= reach;
    };
    Pairs expected;
    for (std::uint32_t i = 0; i < points.size(); ++i)
      for (std::uint32_t j = i + 1; j < points.size(); ++j)
        if (near(points[i], points[j])) expected.push_back({i, j});
    const auto found = collect([&](auto&& sink) {
      report_within_reach<2>(
          Span<const Point>(points), reach, [](const Point& p, std::size_t d) { return p[d]; }, near, sink);
    });
    ASSERT_TRUE(same_pairs(found, expected, "round " + std::to_string(round)));
  }
}

TEST(Thick, FewPredicatesForFewPairs) {
  Random random(9);
  const auto set = cubes<2>(6000, random, 12'000, 40, 80, Layout::scattered);
  std::uint64_t asked = 0, pairs = 0;
  report_intersections<2>(
      Span<const Cube<2>>(set), 80.0, [](const Cube<2>& cube, std::size_t d) { return cube.reference[d]; },
      [&](const Cube<2>& a, const Cube<2>& b) {
        ++asked;
        return meet(a, b);
      },
      [&](std::uint32_t, std::uint32_t) { ++pairs; });
  EXPECT_EQ(pairs, brute_force(set).size());
  EXPECT_GT(pairs, 1000u);
  // Two slabs and a leaf each, and a bounded number of disjoint objects within reach to either side: far from n^2 / 2 =
  // 2e7.
  EXPECT_LT(asked, 40u * (6000 + pairs));
}

/// Two arrays of items, allocated once each, whether there are no pairs or all.
TEST(Thick, MemoryIsLinear) {
  using Point = std::array<float, 3>;
  for (const float reach : {0.0F, 0.01F, 1.0F})
    for (const std::size_t n : {1000u, 2000u}) {
      Random random(10);
      std::vector<Point> points(n);
      for (Point& p : points)
        for (float& x : p) x = static_cast<float>(random.unit());
      std::uint64_t pairs = 0;
      const std::uint64_t allocations = heap_watch::allocations();
      const std::int64_t live = heap_watch::live_bytes();
      heap_watch::reset_peak();
      report_within_reach<3>(
          Span<const Point>(points), reach, [](const Point& p, std::size_t d) { return p[d]; },
          [&](const Point& a, const Point& b) {
            for (int d = 0; d < 3; ++d)
              if (std::abs(a[static_cast<std::size_t>(d)] - b[static_cast<std::size_t>(d)]) > reach) return false;
            return true;
          },
          [&](std::uint32_t, std::uint32_t) { ++pairs; });
      EXPECT_EQ(heap_watch::allocations() - allocations, 2u);
      const std::int64_t bytes = heap_watch::peak_bytes() - live, item = sizeof(Point) + sizeof(std::uint32_t);
      EXPECT_GE(bytes, 2 * item * static_cast<std::int64_t>(n));
      EXPECT_LT(bytes, 2 * item * static_cast<std::int64_t>(n) + 100);  // what the allocator rounds up
      EXPECT_EQ(heap_watch::live_bytes(), live);
      if (reach == 1) {
        EXPECT_EQ(pairs, n * (n - 1) / 2);
      }
    }
}

TEST(Thick, SaysWhatItCannotDo) {
  using Point = std::array<double, 2>;
  const auto run = [](std::vector<Point> points, double diameter) {
    report_intersections<2>(
        Span<const Point>(points), diameter, [](const Point& p, std::size_t d) { return p[d]; },
        [](const Point&, const Point&) { return true; }, [](std::uint32_t, std::uint32_t) {});
  };
  run({{0, 0}, {1, 1}}, 1);
  EXPECT_THROW(run({{0, 0}, {1, 1}}, -1), std::invalid_argument);
  EXPECT_THROW(run({{0, 0}}, std::nan("")), std::invalid_argument);
  EXPECT_THROW(run({{0, std::nan("")}}, 1), std::invalid_argument);
  EXPECT_THROW(run({{std::numeric_limits<double>::infinity(), 0}}, 1), std::invalid_argument);
  run({}, 1);
}

}  // namespace
}  // namespace boxstream::papers::tests
