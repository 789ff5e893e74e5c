// SPDX-License-Identifier: MIT
// Rays against an exact slab test: of all that graze faces, edges and corners none is missed where the arithmetic has
// nothing to round, and none that goes further in where it has.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include <boxstream/world.hpp>

#include "core/random.hpp"

namespace boxstream::tests {
namespace {

struct Segment {
  int origin[3];
  int direction[3];
  int length;
};

/// Exact: bounds and origins are small whole numbers (`shrink` a small fraction of one), and so is a common multiple of
/// the directions that the caller chooses from.
bool meets(const Segment& s, const BasicAabb<double>& box, double shrink) {
  constexpr int multiple = 840;  // of 1 to 8
  double enter = 0, leave = double(s.length) * multiple;
  for (int d = 0; d < 3; ++d) {
    const double below = box.min[d] + shrink - s.origin[d], above = box.max[d] - shrink - s.origin[d];
    if (below > above) return false;
    if (s.direction[d] == 0) {
      if (below > 0 || above < 0) return false;
      continue;
    }
    const double a = below * (multiple / s.direction[d]), b = above * (multiple / s.direction[d]);
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

template <class S>
class Rays : public testing::Test {
 protected:
  /// Boxes on a grid of whole numbers, points and flat ones among them.
  Rays() {
    Random random(1);
    for (int i = 0; i < 400; ++i) {
      BasicAabb<double> box{};
      for (int d = 0; d < 3; ++d) {
        box.min[d] = random.integer(-8, 8);
        box.max[d] = box.min[d] + random.integer(0, 3);
      }
      boxes_.push_back(box);
      ids_.push_back(world_.create(
          {{S(box.min[0]), S(box.min[1]), S(box.min[2])}, {S(box.max[0]), S(box.max[1]), S(box.max[2])}}));
    }
  }

  std::vector<bool> found(const Segment& s) {
    const S origin[3] = {S(s.origin[0]), S(s.origin[1]), S(s.origin[2])};
    const S direction[3] = {S(s.direction[0]), S(s.direction[1]), S(s.direction[2])};
    std::vector<bool> met(boxes_.size());
    world_.query_ray(BasicRay<S>::along(origin, direction, S(s.length)), [&](ProxyId id, S enter, S length) {
      EXPECT_GE(enter, 0);
      EXPECT_LE(enter, length);
      EXPECT_FALSE(met[id.slot]) << "met twice";
      met[id.slot] = true;
      return length;
    });
    return met;
  }

  BasicWorld<S> world_;
  std::vector<BasicAabb<double>> boxes_;
  std::vector<ProxyId> ids_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Rays, Scalars);

Segment random_segment(Random& random, const std::vector<int>& steps) {
  Segment s{};
  for (int d = 0; d < 3; ++d) {
    s.origin[d] = random.integer(-10, 10);
    s.direction[d] = steps[random.index(steps.size())];
  }
  s.length = random.integer(0, 6);
  return s;
}

/// Inverses of powers of two are exact: so is the answer, for rays along axes, of no length, and through corners.
TYPED_TEST(Rays, GrazingOnesAreExactWhereNothingIsRounded) {
  Random random(2);
  std::size_t grazing = 0, points = 0;
  for (int ray = 0; ray < 4000; ++ray) {
    const Segment s = random_segment(random, {0, 0, 1, -1, 2, -2, 4});
    const auto met = this->found(s);
    for (std::size_t i = 0; i < this->boxes_.size(); ++i) {
      const bool exact = meets(s, this->boxes_[i], 0);
      ASSERT_EQ(met[i], exact) << "ray " << ray << ", box " << i;
      grazing += exact && !meets(s, this->boxes_[i], 0x1p-10);
      points += exact && (s.length == 0 || (s.direction[0] == 0 && s.direction[1] == 0 && s.direction[2] == 0));
    }
  }
  EXPECT_GT(grazing, 1000u);
  EXPECT_GT(points, 100u);
}

TYPED_TEST(Rays, AreASupersetOfTheExactTestButForRounding) {
  Random random(3);
  const double rounding = 64 * static_cast<double>(std::numeric_limits<TypeParam>::epsilon());
  std::size_t inside = 0;
  for (int ray = 0; ray < 4000; ++ray) {
    const Segment s = random_segment(random, {0, 1, -3, 5, -6, 7});
    const auto met = this->found(s);
    for (std::size_t i = 0; i < this->boxes_.size(); ++i) {
      const bool exact = meets(s, this->boxes_[i], rounding);
      ASSERT_TRUE(met[i] || !exact) << "ray " << ray << ", box " << i;
      ASSERT_TRUE(!met[i] || meets(s, this->boxes_[i], -rounding)) << "ray " << ray << ", box " << i;
      inside += exact;
    }
  }
  EXPECT_GT(inside, 1000u);
}

/// However many boxes there are: an infinite direction leads nowhere, from wherever.
TYPED_TEST(Rays, OfInfiniteDirectionsAreTheirOrigins) {
  using S = TypeParam;
  constexpr S inf = std::numeric_limits<S>::infinity();
  for (const int count : {1, 30, 700}) {
    BasicWorld<S> world;
    for (int i = 0; i < count; ++i)
      world.create({{S(3 * i), -1, -1}, {S(3 * i + 1), 1, 1}});  // the origin of the second ray is in the first
    for (const S from : {S(-5), S(0.5)})
      for (const S along : {inf, -inf})
        for (const S across : {S(0), S(1)}) {
          int hits = 0;
          world.query_ray(BasicRay<S>::along({from, 0, 0}, {along, across, 0}, 1), [&](ProxyId, S enter, S length) {
            ++hits;
            EXPECT_EQ(enter, S(0));
            return length;
          });
          EXPECT_EQ(hits, from > 0 ? 1 : 0) << count << " boxes, from " << from << " along " << along;
        }
  }
}

}  // namespace
}  // namespace boxstream::tests
