// SPDX-License-Identifier: MIT
// Worlds and balls of floats asked with doubles, against sums in wider numbers.
#include <cmath>
#include <limits>
#include <set>

#include "handles.hpp"
#include "random.hpp"

namespace boxstream::c_test {
namespace {

using tests::Random;
using Boxes = std::vector<Box<float>>;
constexpr double inf = std::numeric_limits<double>::infinity();

/// A float of some binades around 2^exponent.
float any_float(Random& random, int exponent) {
  return static_cast<float>(std::ldexp(random.between(-1, 1), exponent + random.integer(-3, 0)));
}

Boxes any_boxes(Random& random, int exponent, std::size_t count) {
  Boxes boxes(count);
  for (Box<float>& box : boxes)
    for (std::size_t d = 0; d < 3; ++d) {
      const float x = any_float(random, exponent), y = any_float(random, exponent);
      box[d] = std::min(x, y), box[d + 3] = std::max(x, y);
    }
  return boxes;
}

/// A double at `x`, or between it and the next float, or at the next double.
double beside(Random& random, float x) {
  const float next = std::nextafter(x, random.chance(0.5) ? 1e38F : -1e38F);
  const double steps[] = {0, 0.25, 0.5, 0.75, 1};
  const double between = x + (double(next) - x) * steps[random.index(5)];
  return random.chance(0.3) ? std::nextafter(between, random.chance(0.5) ? inf : -inf) : between;
}

/// With sides beside those of boxes.
Box<double> any_query(Random& random, const Boxes& boxes) {
  Box<double> query{};
  for (std::size_t d = 0; d < 3; ++d) {
    const double x = beside(random, boxes[random.index(boxes.size())][random.chance(0.5) ? d : d + 3]);
    const double y = beside(random, boxes[random.index(boxes.size())][random.chance(0.5) ? d : d + 3]);
    query[d] = std::min(x, y), query[d + 3] = std::max(x, y);
  }
  return query;
}

bool touch(const Box<double>& query, const Box<float>& box) {
  for (std::size_t d = 0; d < 3; ++d)
    if (query[d] > query[d + 3] || query[d] > double(box[d + 3]) || double(box[d]) > query[d + 3]) return false;
  return true;
}

constexpr int exponents[] = {-135, -120, -40, 0, 3, 60, 126};

TEST(Doubles, BoxesAskedOfFloatsCountAsTheyAre) {
  Random random(1);
  int found_in_all = 0, left_out_in_all = 0;
  for (const int exponent : exponents) {
    const Boxes boxes = any_boxes(random, exponent, 60);
    std::vector<boxstream_id> ids;
    const World world = make_world(boxes, ids);
    for (int i = 0; i < 2000; ++i) {
      const Box<double> query = any_query(random, boxes);
      std::set<std::uint64_t> found, expected;
      ASSERT_EQ(query_box(world, query,
                          [&](boxstream_id id) { return found.insert(boxstream_world_user(world.get(), id)).second; }),
                BOXSTREAM_OK);
      for (std::size_t k = 0; k < boxes.size(); ++k)
        if (touch(query, boxes[k])) expected.insert(k);
      ASSERT_EQ(found, expected) << "2^" << exponent << ", query " << i;
      found_in_all += int(found.size()), left_out_in_all += int(boxes.size() - found.size());
    }
  }
  EXPECT_GT(found_in_all, 10'000);
  EXPECT_GT(left_out_in_all, 10'000);
}

/// Between two neighbours among the floats lies a box that no float is in.
TEST(Doubles, ABoxBetweenTwoFloats) {
  const float low = 3, high = std::nextafter(low, 4.0F);
  const Boxes boxes{{low, low, low, high, high, high}, {2, 2, 2, low, low, low}, {high, high, high, 5, 5, 5}};
  std::vector<boxstream_id> ids;
  const World world = make_world(boxes, ids);
  const double middle = (double(low) + high) / 2, above = std::nextafter(middle, 4);
  std::vector<std::uint64_t> found;
  const auto note = [&](boxstream_id id) {
    found.push_back(boxstream_world_user(world.get(), id));
    return true;
  };
  query_box(world, {middle, middle, middle, above, above, above}, note);
  EXPECT_EQ(found, std::vector<std::uint64_t>{0});
  found.clear();
  query_box(world, {above, middle, middle, middle, above, above}, note);  // min > max, of one float
  EXPECT_TRUE(found.empty());
  query_near(world, {above, middle, middle, middle, above, above}, inf, [&](boxstream_id id, double) {
    note(id);
    return inf;
  });
  EXPECT_TRUE(found.empty());
  query_box(world, {-1e300, -1e300, -1e300, 1e300, 1e300, 1e300}, note);
  EXPECT_EQ(found.size(), 3u);
}

/// In wider numbers than double, not exact.
long double distance_between(const Box<double>& query, const Box<float>& box) {
  long double square = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const long double from = query[d], to = query[d + 3], below = box[d] - to, above = from - box[d + 3];
    const long double gap = std::max({0.0L, below, above});
    square += gap * gap;
  }
  return std::sqrt(square);
}

TEST(Doubles, NothingNearerThanALimitIsLost) {
  Random random(2);
  int cases = 0;
  for (const int exponent : exponents) {
    const Boxes boxes = any_boxes(random, exponent, 40);
    std::vector<boxstream_id> ids;
    const World world = make_world(boxes, ids);
    for (int i = 0; i < 500; ++i) {
      const Box<double> query = any_query(random, boxes);
      const long double exact = distance_between(query, boxes[random.index(boxes.size())]);
      const double limit = std::nextafter(double(exact), inf);
      std::set<std::uint64_t> found;
      query_near(world, query, limit, [&](boxstream_id id, double distance) {
        const std::uint64_t user = boxstream_world_user(world.get(), id);
        const long double truth = distance_between(query, boxes[user]);
        EXPECT_LE(distance, truth * (1 + 1e-18L));
        EXPECT_GE(distance, truth - std::ldexp(1.0L, exponent - 20) - 1e-44L);
        EXPECT_TRUE(found.insert(user).second);
        return limit;
      });
      for (std::size_t k = 0; k < boxes.size(); ++k)
        if (distance_between(query, boxes[k]) < limit) {
          ASSERT_TRUE(found.count(k)) << "2^" << exponent;
          ++cases;
        }
    }
  }
  EXPECT_GT(cases, 10'000);
}

TEST(Doubles, NoPairNearerThanALimitIsLost) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    // Apart by a float; a limit one double above it. Rounded to a float this would be the distance itself.
    const float gap = std::abs(any_float(random, 10)) + 1e-3F;
    const Boxes boxes{{-1, 0, 0, 0, 1, 1}, {gap, 0, 0, gap + 1, 1, 1}};
    std::vector<boxstream_id> ids;
    const World world = make_world(boxes, ids);
    int seen = 0;
    near_pairs(world, std::nextafter(double(gap), inf), [&](boxstream_id_pair, double distance) {
      EXPECT_LE(distance, double(gap));
      ++seen;
      return inf;
    });
    EXPECT_EQ(seen, 1) << gap;
  }
}

struct Ball {
  float x, y, z, radius;
};

std::size_t count_near(const Detector& detector, const std::vector<Ball>& balls, double distance) {
  const boxstream_balls view{BOXSTREAM_FLOAT, balls.data(), balls.size()};
  const boxstream_pair* pairs = nullptr;
  std::size_t count = SIZE_MAX;
  EXPECT_EQ(boxstream_find_near_pairs(detector.get(), &view, distance, &pairs, &count, nullptr), BOXSTREAM_OK);
  return count;
}

/// Sums of a few floats of like size are exact in doubles, and so is where on a line a gap ends.
TEST(Doubles, BallsOfFloatsAreNearExactly) {
  Random random(4);
  const Detector detector = make_detector();
  for (int i = 0; i < 5000; ++i) {
    const auto exponent = random.integer(-100, 100);
    const auto quarter = [&](int least) {
      return static_cast<float>(std::ldexp(random.integer(least, 1 << 20), exponent));
    };
    const Ball a{quarter(-1000), 0, 0, quarter(0) / 8}, b{a.x + 4 * quarter(1 << 19), 0, 0, quarter(0) / 8};
    const double gap = std::abs(double(b.x) - a.x) - a.radius - b.radius;
    if (gap <= 0) continue;
    EXPECT_EQ(count_near(detector, {a, b}, gap), 1u) << i;
    EXPECT_EQ(count_near(detector, {a, b}, std::nextafter(gap, 0.0)), 0u) << i;
    EXPECT_EQ(count_near(detector, {a, b}, std::nextafter(gap, inf)), 1u) << i;
  }
  const float third = 1.0F / 3;
  EXPECT_EQ(count_near(detector, {{0, 0, 0, 0}, {0.7F, 0, 0, 0}}, 0.7), 1u);  // 0.7F is below it
  EXPECT_EQ(count_near(detector, {{0, 0, 0, 0}, {third, 0, 0, 0}}, 1.0 / 3), 0u);
}

TEST(Doubles, DistancesBeyondFloatsAreFinite) {
  const Detector detector = make_detector();
  const std::vector<Ball> balls{{-3e38F, 0, 0, 0}, {3e38F, 0, 0, 0}, {0, 3e38F, 0, 1e38F}};
  EXPECT_EQ(count_near(detector, balls, 5e38), 2u);
  for (const double distance : {7e38, 1e39, 1e200, std::numeric_limits<double>::max()})
    EXPECT_EQ(count_near(detector, balls, distance), 3u) << distance;
}

/// Where a ray passes a box by more than its own rounding there is no doubt.
TEST(Doubles, RaysAreWithinTheirRounding) {
  Random random(5);
  int hits = 0, misses = 0;
  for (const int exponent : {-40, 0, 8, 60}) {
    const Boxes boxes = any_boxes(random, exponent, 40);
    std::vector<boxstream_id> ids;
    const World world = make_world(boxes, ids);
    for (int i = 0; i < 3000; ++i) {
      double origin[3], direction[3];
      for (int d = 0; d < 3; ++d) origin[d] = std::ldexp(random.between(-2, 2), exponent);
      for (int d = 0; d < 3; ++d) direction[d] = random.between(-1, 1);
      const double length = std::ldexp(random.between(0, 4), exponent), slack = std::ldexp(1.0, exponent - 18);
      const auto meets = [&](const Box<float>& box, double more) {
        double enter = 0, leave = length;
        for (std::size_t d = 0; d < 3; ++d) {
          const double a = (box[d] - more - origin[d]) / direction[d],
                       b = (box[d + 3] + more - origin[d]) / direction[d];
          enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
          if (box[d] - more > box[d + 3] + more) return false;
        }
        return enter <= leave;
      };
      std::set<std::uint64_t> found;
      query_ray(world, origin, direction, length, [&](boxstream_id id, double, double rest) {
        found.insert(boxstream_world_user(world.get(), id));
        return rest;
      });
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        const bool surely = meets(boxes[k], -slack), perhaps = meets(boxes[k], slack);
        if (surely || !perhaps) {
          EXPECT_EQ(found.count(k) != 0, surely) << "2^" << exponent << ", ray " << i;
        }
        hits += surely, misses += !perhaps;
      }
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 10'000);
}

/// The end of a ray between two floats reaches what begins there.
TEST(Doubles, TheLengthOfARayIsNotShortened) {
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const float at = std::ldexp(1.0F + 0x1p-23F * static_cast<float>(random.index(1 << 20)), random.integer(-20, 20));
    const Boxes boxes{{at, -1, -1, 2 * at, 1, 1}};
    std::vector<boxstream_id> ids;
    const World world = make_world(boxes, ids);
    const double origin[] = {0, 0, 0}, direction[] = {1, 0, 0};
    for (const double length : {double(at), std::nextafter(double(at), inf)}) {
      int seen = 0;
      query_ray(world, origin, direction, length, [&](boxstream_id, double enter, double rest) {
        EXPECT_EQ(enter, double(at));
        EXPECT_GE(rest, length);
        ++seen;
        return -1.0;
      });
      EXPECT_EQ(seen, 1);
    }
  }
}

/// Rounded up to a float a negative number may be -0, which is none.
TEST(Doubles, ANegativeNumberStopsHoweverSmallItIs) {
  const Boxes boxes{{-1, -1, -1, 1, 1, 1}, {-2, -2, -2, 2, 2, 2}, {0, 0, 0, 3, 3, 3}};
  std::vector<boxstream_id> ids;
  const World world = make_world(boxes, ids);
  const double origin[] = {0, 0, 0}, direction[] = {1, 0, 0}, nan = std::numeric_limits<double>::quiet_NaN();
  const auto hits = [&](double length, double answer) {
    int seen = 0;
    query_ray(world, origin, direction, length, [&](boxstream_id, double, double) { return ++seen, answer; });
    return seen;
  };
  const auto near = [&](double limit, double answer) {
    int seen = 0;
    query_near(world, {0, 0, 0, 0, 0, 0}, limit, [&](boxstream_id, double) { return ++seen, answer; });
    return seen;
  };
  const auto pairs = [&](double answer) {
    int seen = 0;
    near_pairs(world, inf, [&](boxstream_id_pair, double) { return ++seen, answer; });
    return seen;
  };
  for (const double negative : {-inf, -1.0, -1e-30, -1e-45, -1e-46, -1e-50, -1e-310, -0x1p-1074}) {
    EXPECT_EQ(hits(inf, negative), 1) << negative;
    EXPECT_EQ(hits(negative, inf), 0) << negative;
    EXPECT_EQ(near(inf, negative), 1) << negative;
    EXPECT_EQ(near(negative, inf), 0) << negative;
    EXPECT_EQ(pairs(negative), 1) << negative;
  }
  for (const double none : {0.0, -0.0, nan}) {
    EXPECT_EQ(near(inf, none), 1) << none;
    EXPECT_EQ(near(none, inf), 0) << none;
    EXPECT_EQ(pairs(none), 1) << none;
  }
  for (const double zero : {0.0, -0.0}) EXPECT_EQ(hits(inf, zero), 3) << zero;  // a length of which the start is left
  EXPECT_EQ(near(inf, 1e-300), 3);
}

TEST(Doubles, NearestToAPointWithinItsRounding) {
  Random random(7);
  for (const int exponent : {-40, 0, 20}) {
    const Boxes boxes = any_boxes(random, exponent, 50);
    std::vector<boxstream_id> ids;
    const World world = make_world(boxes, ids);
    for (int i = 0; i < 200; ++i) {
      double p[3];
      for (double& x : p) x = std::ldexp(random.between(-2, 2), exponent);
      const Box<double> point{p[0], p[1], p[2], p[0], p[1], p[2]};
      std::vector<long double> distances;
      for (const Box<float>& box : boxes) distances.push_back(distance_between(point, box));
      boxstream_id nearest[5];
      std::size_t found = 0;
      ASSERT_EQ(boxstream_world_query_nearest(world.get(), p, nearest, 5, &found), BOXSTREAM_OK);
      ASSERT_EQ(found, 5u);
      std::vector<long double> sorted = distances;
      std::sort(sorted.begin(), sorted.end());
      for (std::size_t k = 0; k < 5; ++k)
        EXPECT_NEAR(double(distances[boxstream_world_user(world.get(), nearest[k])]), double(sorted[k]),
                    std::ldexp(1.0, exponent - 20));
    }
  }
}

}  // namespace
}  // namespace boxstream::c_test
