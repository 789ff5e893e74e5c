// SPDX-License-Identifier: MIT
// Queries where squares and sums leave the range of their numbers: every magnitude beside every other one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <boxstream/world.hpp>

#include "world/point_distance.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Magnitudes : public testing::Test {
 protected:
  using Limits = std::numeric_limits<S>;
  using Box = BasicAabb<S>;

  unsigned below(unsigned n) { return static_cast<unsigned>(random_()) % n; }

  /// Of any size from `least` to `greatest` (exponents), of few digits or of all; both signs.
  S number(int least, int greatest) {
    const int exponent = least + static_cast<int>(below(static_cast<unsigned>(greatest - least + 1)));
    const int digits = below(2) == 0 ? 3 : Limits::digits;
    const S whole = static_cast<S>(random_() >> (64 - digits));
    return std::ldexp(below(2) == 0 ? whole : -whole, exponent - digits);
  }

  static constexpr int lowest = Limits::min_exponent - Limits::digits;

  /// A window of exponents: all there are, or a few around those at which squares vanish or overflow.
  void choose_window() {
    const int middles[] = {lowest + 3, Limits::min_exponent / 2, 0, Limits::max_exponent / 2, Limits::max_exponent - 3};
    const int middle = middles[below(5)];
    least_ = below(3) == 0 ? lowest : std::max(lowest, middle - 5);
    greatest_ = below(3) == 0 ? Limits::max_exponent : std::min<int>(Limits::max_exponent, middle + 5);
  }

  S coordinate() {
    const S special[] = {0, Limits::infinity(), -Limits::infinity(), Limits::max(), -Limits::max()};
    return below(40) == 0 ? special[below(5)] : number(least_, greatest_);
  }

  Box box() {
    Box b{};
    for (int d = 0; d < 3; ++d) {
      const S x = coordinate(), y = below(3) == 0 ? x : coordinate();
      b.min[d] = std::min(x, y);
      b.max[d] = std::max(x, y);
    }
    return b;
  }

  /// As near to the point as another box, or nearly so: turned about it, and moved by one step of a bound.
  Box tied(const S (&point)[3], const Box& other) {
    Box b = other;
    const unsigned turn = below(3), mirrored = below(8);
    for (unsigned d = 0; d < 3; ++d) {
      const unsigned from = (d + turn) % 3;
      const S lo = other.min[from] - point[from], hi = other.max[from] - point[from];
      const bool mirror = (mirrored >> d & 1) != 0;
      b.min[d] = point[d] + (mirror ? -hi : lo);
      b.max[d] = point[d] + (mirror ? -lo : hi);
    }
    if (below(2) == 0) b.min[below(3)] = std::nextafter(b.min[below(3)], -Limits::infinity());
    return is_valid(b) ? b : other;
  }

  std::mt19937_64 random_{5};
  int least_ = 0, greatest_ = 0;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Magnitudes, Scalars);

TYPED_TEST(Magnitudes, NearestAreThoseOfExactArithmetic) {
  using S = TypeParam;
  for (int round = 0; round < 600; ++round) {
    this->choose_window();
    S point[3];
    for (S& x : point) x = this->below(4) == 0 ? S(0) : this->coordinate();
    BasicWorld<S> world;
    std::vector<std::pair<PointDistance, std::size_t>> expected;
    std::vector<ProxyId> ids;
    std::vector<BasicAabb<S>> boxes;
    const unsigned n = 2 + this->below(round % 10 == 0 ? 1000 : 40);
    while (boxes.size() < n) {
      const bool ties = !boxes.empty() && this->below(3) == 0;
      const auto box = ties ? this->tied(point, boxes[this->below(static_cast<unsigned>(boxes.size()))]) : this->box();
      expected.push_back({PointDistance(point, box), boxes.size()});
      boxes.push_back(box);
      ids.push_back(world.create(box));
    }
    std::sort(expected.begin(), expected.end());
    std::vector<ProxyId> found(1 + this->below(50));
    found.resize(world.query_nearest(point, Span<ProxyId>(found)));
    for (std::size_t i = 0; i < found.size(); ++i)
      ASSERT_TRUE(found[i] == ids[expected[i].second]) << "round " << round << ", place " << i << " of " << n;
  }
}

/// What squares cannot tell.
TEST(Magnitudes64, NearestWhereSquaresOverflowOrVanish) {
  for (const auto& [far, near] : {std::pair(9e200, 2e160), std::pair(9e-165, 1e-200), std::pair(1.7e308, 1e308)}) {
    World64 world;
    world.create({{far, 0, 0}, {far, 1, 1}});
    const ProxyId nearer = world.create({{near, 0, 0}, {near, 1, 1}});
    ProxyId found[1];
    ASSERT_EQ(world.query_nearest({0, 0, 0}, found), 1u);
    EXPECT_TRUE(found[0] == nearer) << far << " and " << near;
  }
}

/// From one end of the range to the other: the way is longer than the largest number, the length is not.
TYPED_TEST(Magnitudes, RaysAcrossTheWholeRange) {
  using S = TypeParam;
  constexpr S most = std::numeric_limits<S>::max(), inf = std::numeric_limits<S>::infinity();
  for (const unsigned others : {0u, 500u}) {
    BasicWorld<S> world;
    for (unsigned i = 0; i < others; ++i) world.create(this->box());
    const S far = most / 8 * 7;
    const ProxyId target = world.create({{far, -1, -1}, {far, 1, 1}});
    const ProxyId behind = world.create({{-most, -1, -1}, {-most / 16 * 15, 1, 1}});
    struct Case {
      BasicRay<S> ray;
      S enter;
    };
    const BasicRay<S> half_speed{{-far, 0, 0}, {8 / most, inf, inf}, 16};
    const BasicRay<S> unlimited{{-far, 0, 0}, {S(0.25), inf, inf}, inf};
    const BasicRay<S> swept{{far, 0, 0}, {-1, inf, inf}, most, {-most, 0, 0}, {most, 0, 0}};
    const Case cases[] = {{half_speed, 14}, {unlimited, far / 2}, {swept, 0}};
    for (const Case& c : cases) {
      S enter = -1;
      world.query_ray(c.ray, [&](ProxyId id, S at, S length) {
        if (id == target) enter = at;
        EXPECT_FALSE(id == behind && c.enter != 0);
        return length;
      });
      EXPECT_LE(std::abs(enter - c.enter), c.enter * 4 * std::numeric_limits<S>::epsilon());
    }
  }
}

}  // namespace
}  // namespace boxstream::tests
