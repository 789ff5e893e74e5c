// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "float_environment.hpp"
#include "near_values.hpp"

namespace boxstream::tests {
namespace {

template <class S>
S up(S value) {
  return std::nextafter(value, std::numeric_limits<S>::infinity());
}
template <class S>
S down(S value) {
  return std::nextafter(value, -std::numeric_limits<S>::infinity());
}

/// Distances around the one between two balls, to a few ulps.
std::vector<float> distances_around(const Ball& a, const Ball& b) {
  double square = 0;
  for (int d = 0; d < 3; ++d) square += std::pow(double(a.centre[d]) - double(b.centre[d]), 2);
  const double gap = std::sqrt(square) - double(a.radius) - double(b.radius);
  std::vector<float> all;
  auto distance = static_cast<float>(std::max(0.0, gap));
  for (int i = 0; i < 2; ++i) distance = std::max(0.0F, down(distance));
  // Below 2^-6, the next float could be finer than what the truth can take.
  for (int i = 0; i < 5; ++i, distance = up(distance))
    if (distance == 0 || (distance >= 0x1p-6F && distance < 0x1p30F)) all.push_back(distance);
  return all;
}

TEST(IsNear, AgreesWithIntegers) {
  Random random(1);
  int near = 0, far = 0;
  for (int i = 0; i < 100'000; ++i) {
    const Ball a = any_ball(random), b = any_ball(random);
    for (const float distance : distances_around(a, b)) {
      const bool truth = truly_near(a, b, distance);
      ASSERT_EQ(is_near(a, b, distance), truth) << "pair " << i;
      ASSERT_EQ(is_near(b, a, distance), truth) << "pair " << i;
      ++(truth ? near : far);
    }
  }
  EXPECT_GT(near, 50'000);
  EXPECT_GT(far, 50'000);
}

/// The whole part of the square root.
Int128 root_of(Int128 square) {
  auto root = static_cast<Int128>(std::sqrt(static_cast<double>(square)));
  while (root * root > square) --root;
  while ((root + 1) * (root + 1) <= square) ++root;
  return root;
}

/// Sums of three floats that meet a distance to its 60th bit, where sums in double are often wrong.
TEST(IsNear, MeetsDistancesToTheLastBit) {
  Random random(8);
  int doubles_wrong = 0;
  for (int i = 0; i < 20'000; ++i) {
    Ball a = any_ball(random), b = any_ball(random);
    Int128 square = 0;
    double rounded = 0;
    for (int d = 0; d < 3; ++d) {
      const double difference = double(a.centre[d]) - double(b.centre[d]);
      rounded += difference * difference;
      const auto whole = static_cast<Int128>(std::ldexp(double(a.centre[d]), fraction_bits)) -
                         static_cast<Int128>(std::ldexp(double(b.centre[d]), fraction_bits));
      square += whole * whole;
    }
    const Int128 root = root_of(square);
    for (Int128 reach = root > 2 ? root - 2 : 0; reach <= root + 2; ++reach) {
      // 24 bits in each of the first two, which floats hold, and what is left.
      float parts[3];
      Int128 rest = reach;
      for (const int shift : {38, 14, 0}) {
        const Int128 part = rest >> shift << shift;
        parts[shift == 38 ? 0 : shift == 14 ? 1 : 2] = std::ldexp(static_cast<float>(part), -fraction_bits);
        rest -= part;
      }
      a.radius = parts[0];
      b.radius = parts[1];
      const bool truth = truly_near(a, b, parts[2]);
      ASSERT_EQ(truth, square <= reach * reach);
      ASSERT_EQ(is_near(a, b, parts[2]), truth) << i;
      const double sum = double(parts[0]) + double(parts[1]) + double(parts[2]);
      doubles_wrong += (rounded <= sum * sum) != truth;
    }
  }
  EXPECT_GT(doubles_wrong, 1000);
}

/// One ulp of any number involved to either side, at all magnitudes of floats.
template <class S>
void expect_sharp(int least_exponent, int greatest_exponent) {
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const Touching<S> t = touching<S>(random, random.integer(least_exponent, greatest_exponent));
    ASSERT_TRUE(is_near(t.a, t.b, t.distance)) << i;
    ASSERT_TRUE(is_near(t.b, t.a, t.distance)) << i;
    ASSERT_TRUE(is_near(t.a, t.b, up(t.distance))) << i;
    if (t.distance > 0) {
      ASSERT_FALSE(is_near(t.a, t.b, down(t.distance))) << i;
      ASSERT_FALSE(is_near(t.a, t.b, down(double(t.distance)))) << i;
    }
    auto smaller = t.a;
    if (smaller.radius > 0) {
      smaller.radius = down(smaller.radius);
      ASSERT_FALSE(is_near(smaller, t.b, t.distance)) << i;
    }
    for (int d = 0; d < 3; ++d) {
      if (t.a.centre[d] == t.b.centre[d]) continue;
      const bool above = t.a.centre[d] > t.b.centre[d];
      auto moved = t.a;
      moved.centre[d] = above ? up(t.a.centre[d]) : down(t.a.centre[d]);
      ASSERT_FALSE(is_near(moved, t.b, t.distance)) << i;
      moved.centre[d] = above ? down(t.a.centre[d]) : up(t.a.centre[d]);
      ASSERT_TRUE(is_near(moved, t.b, t.distance)) << i;
    }
  }
}

TEST(IsNear, TellsOneUlpInFloat) {
  expect_sharp<float>(-149, 110);
}

TEST(IsNear, TellsOneUlpInDouble) {
  expect_sharp<double>(-1074, 1008);
}

/// Any bits at all that are numbers: whatever the sums in double decide, the exact sum says too.
template <class S, class Bits>
void expect_filter_right() {
  Random random(7);
  const auto any = [&](bool negative) {
    for (;;) {
      const auto bits = static_cast<Bits>(random.index(std::numeric_limits<std::size_t>::max()));
      S value;
      std::memcpy(&value, &bits, sizeof value);
      if (std::isfinite(value)) return negative ? value : std::abs(value);
    }
  };
  int near = 0;
  for (int i = 0; i < 100'000; ++i) {
    const BasicBall<S> a{{any(true), any(true), any(true)}, any(false)};
    // One coordinate in two is nearly the same, so that differences are of any size too.
    BasicBall<S> b = a;
    for (S& x : b.centre) x = random.chance(0.5) ? any(true) : random.chance(0.5) ? up(x) : x;
    const S distance = random.chance(0.5) ? any(false) : 0;
    if (!std::isfinite(b.centre[0]) || !std::isfinite(b.centre[1]) || !std::isfinite(b.centre[2])) continue;
    const bool found = is_near(a, b, distance);
    ASSERT_EQ(found, detail::near_exactly(detail::in_doubles(a), detail::in_doubles(b), double(distance))) << i;
    near += found;
  }
  EXPECT_GT(near, 20'000);
  EXPECT_LT(near, 80'000);
}

TEST(IsNear, FilterAndExactSumAgree) {
  expect_filter_right<float, std::uint32_t>();
  expect_filter_right<double, std::uint64_t>();
}

TEST(IsNear, DoublesAloneWouldBeWrong) {
  const Ball left{{-0x1p-20F, 0, 0}, 0}, right{{0x1p40F, 0, 0}, 0};
  // Rounded to a double, the difference is the distance.
  EXPECT_EQ(double(right.centre[0]) - double(left.centre[0]), 0x1p40);
  EXPECT_FALSE(is_near(left, right, 0x1p40F));
  // And here the squares are the same: 1 + 2^-120 against 1.
  const Ball corner{{1, 0x1p-60F, 0}, 0}, origin{{0, 0, 0}, 0};
  EXPECT_FALSE(is_near(corner, origin, 1.0F));
  EXPECT_FALSE(is_near(corner, {{0, 0, 0}, 0x1p-122F}, 1.0F));
  EXPECT_TRUE(is_near(corner, {{0, 0, 0}, 0x1p-121F}, 1.0F));
  EXPECT_TRUE(is_near(Ball64{{1e308, 0, 0}, 0}, {{-1e308, 0, 0}, 1e308}, 1e308));
  EXPECT_FALSE(is_near(Ball64{{1e308, 5e-324, 0}, 0}, {{-1e308, 0, 0}, 1e308}, 1e308));
  EXPECT_TRUE(is_near(Ball64{{1e308, 5e-324, 0}, 5e-324}, {{-1e308, 0, 0}, 1e308}, 1e308));
}

TEST(IsNear, AnyRoundingMode) {
  Random random(3);
  for (int i = 0; i < 3'000; ++i) {
    const Ball a = any_ball(random), b = any_ball(random);
    for (const float distance : distances_around(a, b)) {
      const bool truth = truly_near(a, b, distance);
      for (const int mode : rounding_modes) {
        bool found = !truth;
        with_rounding(mode, [&] { found = is_near(a, b, distance); });
        ASSERT_EQ(found, truth) << i;
      }
    }
  }
}

template <class S>
std::vector<Pair> brute_force(const std::vector<BasicBall<S>>& balls, S distance) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < balls.size(); ++i)
    for (std::uint32_t j = i + 1; j < balls.size(); ++j)
      if (is_near(balls[i], balls[j], distance)) pairs.push_back({i, j});
  return pairs;
}

template <class S>
void expect_found(const std::vector<BasicBall<S>>& balls, S distance) {
  Detector detector;
  std::vector<Pair> found{{7, 7}}, streamed;
  const Stats stats = find_near_pairs(detector, balls, distance, found);
  EXPECT_EQ(stats.pairs, found.size());
  EXPECT_EQ(stats.boxes, balls.size());
  EXPECT_EQ(stats.invalid, 0u);
  stream_near_pairs(detector, balls, distance, [&](Span<const Pair> pairs) {
    EXPECT_FALSE(pairs.empty());
    streamed.insert(streamed.end(), pairs.begin(), pairs.end());
    return true;
  });
  EXPECT_EQ(streamed, found);
  std::sort(found.begin(), found.end());
  ASSERT_EQ(found, brute_force(balls, distance));
}

TEST(NearPairs, AreThoseOfBruteForce) {
  Random random(4);
  for (int round = 0; round < 40; ++round) {
    std::vector<Ball> balls(random.index(300));
    std::vector<Ball64> doubles;
    const bool points = random.chance(0.3), flat = random.chance(0.3);
    for (Ball& ball : balls) {
      for (float& x : ball.centre) x = static_cast<float>(random.between(-1, 1));
      if (flat) ball.centre[2] = 0;
      ball.radius = points ? 0 : static_cast<float>(random.between(0, 0.2));
      doubles.push_back({{ball.centre[0], ball.centre[1], ball.centre[2]}, ball.radius});
    }
    const auto distance = static_cast<float>(random.between(0, 0.3));
    expect_found(balls, distance);
    expect_found(doubles, double(distance));
  }
}

/// Boxes that are rounded the wrong way would lose these.
template <class S>
void expect_touching_found(int least_exponent, int greatest_exponent) {
  Random random(5);
  Detector detector;
  std::vector<Pair> found;
  for (int i = 0; i < 3'000; ++i) {
    const Touching<S> t = touching<S>(random, random.integer(least_exponent, greatest_exponent));
    const std::vector<BasicBall<S>> balls{t.a, t.b};
    find_near_pairs(detector, balls, t.distance, found);
    ASSERT_EQ(found, (std::vector<Pair>{{0, 1}})) << i;
    if (t.distance == 0) continue;
    for (const double less : {double(down(t.distance)), down(double(t.distance))}) {  // of balls of floats too
      find_near_pairs(detector, balls, less, found);
      ASSERT_TRUE(found.empty()) << i;
    }
  }
}

TEST(NearPairs, TouchingAtEveryMagnitude) {
  expect_touching_found<float>(-149, 110);
  expect_touching_found<double>(-1074, 1008);
}

TEST(NearPairs, HardFloatsAreThoseOfBruteForce) {
  Random random(6);
  for (int round = 0; round < 20; ++round) {
    std::vector<Ball> balls;
    for (int i = 0; i < 100; ++i) balls.push_back(any_ball(random));
    expect_found(balls, random.chance(0.5) ? 0.0F : any_float(random, false));
  }
}

TEST(NearPairs, FloatsWithinADistanceBeyondThem) {
  constexpr float most = std::numeric_limits<float>::max();
  const std::vector<Ball> balls{{{-most, 0, 0}, 0}, {{most, 0, 0}, 0}, {{0, most, most}, 0}};
  Detector detector;
  std::vector<Pair> found;
  for (const double distance : {6e38, 6.9e38, 1e200, std::numeric_limits<double>::max()}) {
    find_near_pairs(detector, balls, distance, found);
    EXPECT_EQ(found.size(), distance < 2.0 * double(most) ? 2u : 3u) << distance;
  }
}

TEST(NearPairs, SamePlace) {
  expect_found(std::vector<Ball>(20, Ball{{1, 2, 3}, 0}), 0.0F);
  expect_found(std::vector<Ball>{}, 1.0F);
  expect_found(std::vector<Ball>(1, Ball{{1, 2, 3}, 1}), 1.0F);
}

TEST(NearPairs, InvalidBallsAreNearNothing) {
  constexpr float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Ball> balls{{{0, 0, 0}, 1},   {{nan, 0, 0}, 1}, {{0, inf, 0}, 1},        {{0, 0, 0}, -1},
                                {{0, 0, 0}, inf}, {{0, 0, 0}, nan}, {{0, 0, -3e38F}, 3e38F}, {{0.5F, 0, 0}, 0}};
  Detector detector;
  std::vector<Pair> found;
  const Stats stats = find_near_pairs(detector, balls, 1.0F, found);
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, (std::vector<Pair>{{0, 6}, {0, 7}, {6, 7}}));
  EXPECT_EQ(stats.invalid, 5u);
}

TEST(NearPairs, SaysWhatItCannotDo) {
  Detector detector;
  const std::vector<Ball> balls(300, Ball{{0, 0, 0}, 1});  // more pairs than the sink is given at once
  std::vector<Pair> found;
  for (const float distance :
       {-1.0F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    found = {{1, 1}};
    EXPECT_THROW(find_near_pairs(detector, balls, distance, found), std::invalid_argument);
    EXPECT_TRUE(found.empty());
  }
  int calls = 0;
  stream_near_pairs(detector, balls, 0.0F, [&](Span<const Pair>) {
    ++calls;
    return false;
  });
  EXPECT_EQ(calls, 1);
  struct Stop {};
  EXPECT_THROW(stream_near_pairs(detector, balls, 0.0F, [](Span<const Pair>) -> bool { throw Stop(); }), Stop);
  find_near_pairs(detector, balls, 0.0F, found);
  EXPECT_EQ(found.size(), 300u * 299 / 2);
}

}  // namespace
}  // namespace boxstream::tests
