// SPDX-License-Identifier: MIT
#include "papers/thick/report_intersections.hpp"

#include <gtest/gtest.h>

#include "core/near_values.hpp"
#include "heap_watch.hpp"
#include "truth.hpp"

namespace boxstream::papers::tests {
namespace {

using boxstream::tests::Random;

template <std::size_t D, class S>
bool check(const std::vector<BasicBall<S>>& balls, S distance, const std::string& what) {
  Pairs expected;
  for (std::uint32_t i = 0; i < balls.size(); ++i)
    for (std::uint32_t j = i + 1; j < balls.size(); ++j)
      if (is_near(balls[i], balls[j], distance)) expected.push_back({i, j});
  bool same = true;
  for (const Pivot pivot : {Pivot::median, Pivot::random})
    same = same && same_pairs(collect([&](auto&& found) {
                                thick_near_pairs<D>(Span<const BasicBall<S>>(balls), distance, found, pivot);
                              }),
                              expected, what);
  Detector detector;
  Pairs engine;
  find_near_pairs(detector, balls, distance, engine);
  return same && same_pairs(engine, expected, "engine, " + what);
}

TEST(ThickNear, PointsDisksAndBalls) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    Random random(seed);
    std::vector<Ball> balls(random.index(400));
    const bool flat = random.chance(0.5);
    const double largest = random.chance(0.3) ? 0 : random.between(0, 0.1), least = random.unit() * largest;
    for (Ball& ball : balls) {
      for (float& x : ball.centre) x = static_cast<float>(random.between(-1, 1));
      if (flat) ball.centre[2] = 0.5F;
      ball.radius = static_cast<float>(random.between(least, largest));
    }
    const auto distance = static_cast<float>(random.chance(0.2) ? 0 : random.between(0, 0.1));
    const std::string what = "seed " + std::to_string(seed);
    ASSERT_TRUE(check<3>(balls, distance, what));
    if (flat) {
      ASSERT_TRUE(check<2>(balls, distance, what + ", flat"));
    }
  }
}

/// Rows of a lattice whose neighbours are at exactly the distance, or one ulp more or less.
TEST(ThickNear, LatticesAtTheBoundary) {
  for (const float spacing : {1.0F, 0.1F, 3e-40F, 1e30F})
    for (const float distance : {spacing, std::nextafter(spacing, 0.0F), std::nextafter(spacing, 1e38F)}) {
      std::vector<Ball> line, square, cube;
      for (int x = 0; x < 64; ++x) line.push_back({{static_cast<float>(x) * spacing, 0, 0}, 0});
      for (int x = 0; x < 12; ++x)
        for (int y = 0; y < 12; ++y)
          square.push_back({{static_cast<float>(x) * spacing, static_cast<float>(y) * spacing, 0}, 0});
      for (int i = 0; i < 216; ++i)
        cube.push_back({{static_cast<float>(i % 6) * spacing, static_cast<float>(i / 6 % 6) * spacing,
                         static_cast<float>(i / 36) * spacing},
                        0});
      ASSERT_TRUE((check<1>(line, distance, "line")));
      ASSERT_TRUE((check<2>(line, distance, "line in the plane")));
      ASSERT_TRUE((check<2>(square, distance, "square")));
      ASSERT_TRUE((check<3>(cube, distance, "cube")));
    }
  // On a grid of whole numbers it is known how many there are.
  std::vector<Ball> grid;
  for (int x = 0; x < 10; ++x)
    for (int y = 0; y < 10; ++y) grid.push_back({{static_cast<float>(x), static_cast<float>(y), 0}, 0});
  const auto count = [&](float distance) {
    std::size_t pairs = 0;
    thick_near_pairs<2>(Span<const Ball>(grid), distance, [&](std::uint32_t, std::uint32_t) { ++pairs; });
    return pairs;
  };
  EXPECT_EQ(count(1), 180u);
  EXPECT_EQ(count(std::nextafter(1.0F, 0.0F)), 0u);
  EXPECT_EQ(count(5) - count(std::nextafter(5.0F, 0.0F)), 2u * 10 * 5 + 2 * 2 * 7 * 6);
}

TEST(ThickNear, SamePlaceAndTouching) {
  ASSERT_TRUE((check<3>(std::vector<Ball>(100, Ball{{1, 2, 3}, 0}), 0.0F, "one place")));
  ASSERT_TRUE((check<3>(std::vector<Ball>{}, 1.0F, "none")));
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const auto t = boxstream::tests::touching<double>(random, random.integer(-1074, 1000));
    ASSERT_TRUE((check<3>(std::vector<Ball64>{t.a, t.b}, t.distance, "touching")));
    ASSERT_TRUE((check<3>(std::vector<Ball64>{t.a, t.b}, std::nextafter(t.distance, 0.0), "one ulp apart")));
  }
}

TEST(ThickNear, HardFloats) {
  Random random(4);
  for (int round = 0; round < 10; ++round) {
    std::vector<Ball> balls;
    for (int i = 0; i < 150; ++i) balls.push_back(boxstream::tests::any_ball(random));
    ASSERT_TRUE((check<3>(balls, boxstream::tests::any_float(random, false), "hard floats")));
  }
}

/// Streamed by a warm detector: a box for each ball and one batch of pairs, whether there are no pairs or all.
TEST(ThickNear, EngineMemoryIsLinear) {
  namespace heap_watch = boxstream::tests::heap_watch;
  constexpr std::size_t n = 2000, largest_batch = 1 << 16;
  Random random(5);
  std::vector<Ball> balls(n);
  for (Ball& ball : balls)
    for (float& x : ball.centre) x = static_cast<float>(random.unit());
  Detector detector;
  for (const float distance : {0.0F, 2.0F}) {
    std::uint64_t pairs = 0;
    const auto count = [&](Span<const Pair> found) {
      EXPECT_LT(found.size(), largest_batch);
      pairs += found.size();
      return true;
    };
    stream_near_pairs(detector, balls, distance, count);
    pairs = 0;
    const std::int64_t live = heap_watch::live_bytes();
    heap_watch::reset_peak();
    stream_near_pairs(detector, balls, distance, count);
    EXPECT_EQ(pairs, distance == 0 ? 0 : n * (n - 1) / 2);
    EXPECT_EQ(heap_watch::live_bytes(), live);
    EXPECT_LT(heap_watch::peak_bytes() - live,
              static_cast<std::int64_t>(n * sizeof(Aabb) + 2 * largest_batch * sizeof(Pair)));
  }
}

TEST(ThickNear, SaysWhatItCannotDo) {
  const auto run = [](Ball ball, float distance) {
    const std::vector<Ball> balls{ball};
    thick_near_pairs<3>(Span<const Ball>(balls), distance, [](std::uint32_t, std::uint32_t) {});
  };
  constexpr float inf = std::numeric_limits<float>::infinity();
  run({{0, 0, 0}, 1}, 1);
  EXPECT_THROW(run({{0, 0, 0}, -1}, 1), std::invalid_argument);
  EXPECT_THROW(run({{0, 0, 0}, inf}, 1), std::invalid_argument);
  EXPECT_THROW(run({{0, inf, 0}, 1}, 1), std::invalid_argument);
  EXPECT_THROW(run({{0, 0, 0}, 1}, -1), std::invalid_argument);
  EXPECT_THROW(run({{0, 0, 0}, 1}, inf), std::invalid_argument);
}

}  // namespace
}  // namespace boxstream::papers::tests
