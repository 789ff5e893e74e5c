// SPDX-License-Identifier: MIT
// Boxes and pairs below a limit: every query against brute force, for visitors that do as they please.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <boxstream/world.hpp>

#include "core/oracle.hpp"
#include "nearest/nearest_distance.hpp"
#include "sanitized.hpp"
#include "simd_targets.hpp"
#include "values.hpp"

namespace boxstream::tests {

namespace {

template <class S>
constexpr S inf = std::numeric_limits<S>::infinity();
template <class S>
constexpr S nan = std::numeric_limits<S>::quiet_NaN();

/// What a visitor answers to the k-th visit.
template <class S>
using Answer = std::function<S(std::size_t k, S distance, S limit)>;

/// Visits: births and distance.
template <class S>
struct Visit {
  S distance;
  std::size_t a, b;

  friend bool operator==(const Visit& x, const Visit& y) {
    return x.distance == y.distance && x.a == y.a && x.b == y.b;
  }
  friend bool operator<(const Visit& x, const Visit& y) {
    return x.distance != y.distance ? x.distance < y.distance : x.a != y.a ? x.a < y.a : x.b < y.b;
  }
};

/// A query as it went: which visits there were, and what the limit was before each of them and at last.
template <class S>
struct Course {
  std::vector<Visit<S>> seen;
  std::vector<S> limits;

  S next(const Visit<S>& visit, const Answer<S>& answer) {
    seen.push_back(visit);
    limits.push_back(answer(seen.size() - 1, visit.distance, limits.back()));
    return limits.back();
  }
};

/// What is promised of any order: every visit is of `all`, once, and below the limit of its time; what is left out is
/// not below the least limit that there was.
template <class S>
void expect_allowed(Course<S> course, std::vector<Visit<S>> all, const char* what, unsigned seed) {
  std::sort(all.begin(), all.end());
  S least = course.limits[0];
  for (std::size_t k = 0; k < course.seen.size(); ++k) {
    const Visit<S>& visit = course.seen[k];
    ASSERT_TRUE(std::binary_search(all.begin(), all.end(), visit))
        << what << ", seed " << seed << ": no visit of (" << visit.a << ", " << visit.b << ") at " << visit.distance;
    ASSERT_LT(visit.distance, course.limits[k]) << what << ", seed " << seed << ": visit " << k;
    if (!(course.limits[k + 1] >= least)) least = course.limits[k + 1];
  }
  std::sort(course.seen.begin(), course.seen.end());
  std::size_t next = 0;
  for (const Visit<S>& visit : all) {
    if (next < course.seen.size() && course.seen[next] == visit)
      ++next;
    else
      ASSERT_FALSE(visit.distance < least)
          << what << ", seed " << seed << ": (" << visit.a << ", " << visit.b << ") is left out";
  }
  ASSERT_EQ(next, course.seen.size()) << what << ", seed " << seed << ": a visit twice";
}

/// A World whose proxies' births are known.
template <class S>
struct Populated {
  BasicWorld<S> world;
  std::vector<ProxyId> ids;  // by birth, dead ones included

  void create(const BasicAabb<S>& box, Filter filter = {}) {
    const ProxyId id = world.create(box, filter);
    ids.push_back(id);
    if (id.slot >= births.size()) births.resize(id.slot + 1);
    births[id.slot] = ids.size() - 1;
  }
  std::size_t birth(ProxyId id) const {
    EXPECT_TRUE(world.contains(id));
    return births[id.slot];
  }
  bool has_box(std::size_t b) const { return world.contains(ids[b]) && makes_sense(world.box(ids[b])); }
  BasicAabb<S> box(std::size_t b) const { return world.box(ids[b]); }
  Filter filter(std::size_t b) const { return world.filter(ids[b]); }

  std::vector<std::size_t> births;  // of what is in each slot now
};

template <class S>
void compare_box_query(const Populated<S>& p, const BasicAabb<S>& box, S limit, const Answer<S>& answer,
                       unsigned seed) {
  std::vector<Visit<S>> all;
  for (std::size_t b = 0; b < p.ids.size(); ++b)
    if (p.has_box(b) && makes_sense(box)) all.push_back({detail::distance_below(box, p.box(b)), b, 0});
  Course<S> course{{}, {limit}};
  p.world.query_nearest_box(box, limit, [&](ProxyId id, S distance) {
    return course.next({distance, p.birth(id), 0}, answer);
  });
  expect_allowed(course, all, "box", seed);
}

template <class S>
void compare_pairs(const Populated<S>& p, S limit, const Answer<S>& answer, unsigned seed) {
  std::vector<Visit<S>> all;
  for (std::size_t b = 0; b < p.ids.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (p.has_box(a) && p.has_box(b) && permit(p.filter(a), p.filter(b)))
        all.push_back({detail::distance_below(p.box(a), p.box(b)), a, b});
  Course<S> course{{}, {limit}};
  p.world.nearest_pairs(limit, [&](ProxyPair pair, S distance) {
    return course.next({distance, p.birth(pair.a), p.birth(pair.b)}, answer);
  });
  expect_allowed(course, all, "pairs", seed);
}

template <class S>
void compare_cross(const Populated<S>& p, const Populated<S>& q, S limit, const Answer<S>& answer, unsigned seed) {
  std::vector<Visit<S>> all;
  for (std::size_t a = 0; a < p.ids.size(); ++a)
    for (std::size_t b = 0; b < q.ids.size(); ++b)
      if (p.has_box(a) && q.has_box(b) && permit(p.filter(a), q.filter(b)))
        all.push_back({detail::distance_below(p.box(a), q.box(b)), a, b});
  Course<S> course{{}, {limit}};
  p.world.nearest_pairs(q.world, limit, [&](ProxyPair pair, S distance) {
    return course.next({distance, p.birth(pair.a), q.birth(pair.b)}, answer);
  });
  expect_allowed(course, all, "two worlds", seed);
}

/// Whatever a caller's distance function may do with the limit.
template <class S>
Answer<S> random_answer(unsigned seed, S scale) {
  // A function of the visit, so that the oracle can ask again.
  const auto chance = [seed](std::size_t k) { return std::mt19937(seed + 977 * static_cast<unsigned>(k))(); };
  const auto when = static_cast<std::size_t>(chance(1) % 40);
  switch (seed % 9) {
    case 0:
      return [](std::size_t, S, S limit) { return limit; };
    case 1:  // exact distances, which are not below the bounds
      return [=](std::size_t k, S distance, S limit) {
        return std::min(limit, distance + scale * S(chance(k) % 100) / 100);
      };
    case 2:
      return [=](std::size_t, S, S) { return scale / 2; };
    case 3:  // up and down
      return
          [=](std::size_t k, S distance, S) { return k % 500 == 499 ? 0 : distance + scale / S(1 + chance(k) % 50); };
    case 4:
      return [=](std::size_t k, S, S limit) { return k == when ? S(0) : limit; };
    case 5:
      return [=](std::size_t k, S, S limit) { return k == when ? nan<S> : limit; };
    case 6:
      return [=](std::size_t k, S, S limit) { return k == when ? S(-1) : limit; };
    case 7:
      return [=](std::size_t, S, S) { return inf<S>; };
    default:  // ever less, by little
      return [=](std::size_t, S distance, S limit) { return std::min(limit, distance + scale) * S(0.999); };
  }
}

template <class S>
S random_limit(unsigned seed, S scale) {
  const S limits[] = {inf<S>, std::numeric_limits<S>::max(), scale, scale / 10, S(0), S(-1), nan<S>};
  return limits[seed / 9 % 7];
}

}  // namespace

template <class S>
class Nearest : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Nearest, Scalars);

/// How a set of boxes is made, and about how far apart they are.
template <class S>
struct Scene {
  const char* name;
  S scale;
  std::function<BasicAabb<S>(std::mt19937&)> make;
};

template <class S>
BasicAabb<S> box_at(std::mt19937& random, S extent, S side) {
  std::uniform_real_distribution<S> place(0, extent), size(0, side);
  BasicAabb<S> box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = place(random);
    box.max[d] = box.min[d] + size(random);
  }
  return box;
}

template <class S>
std::vector<Scene<S>> scenes() {
  return {
      {"scattered", S(5), [](std::mt19937& r) { return box_at<S>(r, 100, 2); }},
      {"dense", S(1), [](std::mt19937& r) { return box_at<S>(r, 10, 4); }},
      {"hard", S(3), [](std::mt19937& r) { return box_from<S>(r()); }},
      {"copies in two places", S(2),
       [](std::mt19937& r) {
         const S x = r() % 2 == 0 ? S(0) : S(3);
         return BasicAabb<S>{{x, 0, 0}, {x + 1, 1, 1}};
       }},
      {"huge", std::numeric_limits<S>::max() / 100,
       [](std::mt19937& r) {
         BasicAabb<S> box = box_at<S>(r, 2, S(0.1));
         for (int d = 0; d < 3; ++d) {
           box.min[d] = (box.min[d] - 1) * (std::numeric_limits<S>::max() / 2);
           box.max[d] = (box.max[d] - 1) * (std::numeric_limits<S>::max() / 2);
         }
         return box;
       }},
      {"tiny", std::numeric_limits<S>::min() * 50,
       [](std::mt19937& r) {
         BasicAabb<S> box = box_at<S>(r, 2000, 5);
         for (int d = 0; d < 3; ++d) {
           box.min[d] *= std::numeric_limits<S>::min() / 5;
           box.max[d] *= std::numeric_limits<S>::min() / 5;
         }
         return box;
       }},
  };
}

/// Inserts, moves near and far, deaths: the index in all its states.
template <class S>
void live_on(Populated<S>& p, const Scene<S>& scene, std::mt19937& random) {
  for (std::size_t b = 0; b < p.ids.size(); b += 1 + random() % 20) {
    if (random() % 3 == 0)
      p.world.destroy(p.ids[b]);
    else
      p.world.move(p.ids[b], scene.make(random));
  }
  for (unsigned i = 0; i < 20; ++i) p.create(scene.make(random), random() % 4 == 0 ? Filter{2, ~2u} : Filter{});
}

template <class S>
void compare_courses(const std::vector<unsigned>& sizes) {
  unsigned seed = 0;
  for (const Scene<S>& scene : scenes<S>()) {
    SCOPED_TRACE(scene.name);
    for (const unsigned n : sizes) {
      std::mt19937 random(n);
      Populated<S> p, q;
      for (unsigned i = 0; i < n; ++i) p.create(scene.make(random));
      for (unsigned i = 0; i < 70; ++i) q.create(scene.make(random));
      for (int frame = 0; frame < 3; ++frame) {
        const int rounds = n < 100 ? 9 : 2;
        for (int i = 0; i < rounds; ++i) {
          const unsigned s = ++seed;
          compare_box_query<S>(p, scene.make(random), random_limit(s, scene.scale), random_answer(s, scene.scale), s);
          compare_pairs<S>(p, random_limit(s, scene.scale), random_answer(s, scene.scale), s);
          compare_cross<S>(p, q, random_limit(s, scene.scale), random_answer(s, scene.scale), s);
          compare_cross<S>(q, p, random_limit(s, scene.scale), random_answer(s, scene.scale), s);
          if (testing::Test::HasFatalFailure()) return;
        }
        live_on(p, scene, random);
        live_on(q, scene, random);
      }
    }
  }
}

TYPED_TEST(Nearest, EveryPairBelowTheLimit) {
  compare_courses<TypeParam>({0, 1, 2, 9, sanitized ? 30 : 60, sanitized ? 60 : 250});
}

using NearestOn = EachSimdTarget;
INSTANTIATE_TEST_SUITE_P(Targets, NearestOn, testing::ValuesIn(simd_targets()), simd_target_name);

TEST_P(NearestOn, EveryPairBelowTheLimit) {
  compare_courses<float>({9, sanitized ? 30 : 100});
  compare_courses<double>({9, sanitized ? 30 : 100});
}

TYPED_TEST(Nearest, AnyNumberOfPairsAtOneDistance) {
  using S = TypeParam;
  const Answer<S> keep = [](std::size_t, S, S limit) { return limit; };
  Populated<S> p, q;
  for (int i = 0; i < 600; ++i) {
    const S x = i % 3 == 0 ? S(0) : S(3);
    (i % 7 == 0 ? q : p).create({{x, 0, 0}, {x + 1, 1, 1}});
  }
  compare_pairs<S>(p, inf<S>, keep, 0);
  compare_cross<S>(p, q, inf<S>, keep, 0);
  compare_cross<S>(p, q, S(2), keep, 0);
  for (const std::size_t stop : {1, 70, 30000, 110000})
    compare_pairs<S>(
        p, inf<S>, [=](std::size_t k, S, S limit) { return k + 1 == stop ? S(0) : limit; }, 0);
}

/// A limit that is the least distance so far finds the nearest pair after few visits, and touching ones at once.
TYPED_TEST(Nearest, NearOnesComeFirst) {
  using S = TypeParam;
  for (const S side : {S(0.5), S(8)}) {
    std::mt19937 random(3);
    Populated<S> p;
    for (int i = 0; i < 3000; ++i) p.create(box_at<S>(random, 100, side));
    std::size_t visits = 0;
    S least = inf<S>;
    p.world.nearest_pairs(inf<S>, [&](ProxyPair, S distance) {
      ++visits;
      return least = std::min(least, distance);
    });
    EXPECT_LE(visits, side > 1 ? 2u : 30u);
    visits = 0;
    for (int i = 0; i < 1000; ++i) {
      least = inf<S>;
      p.world.query_nearest_box(box_at<S>(random, 100, side), inf<S>, [&](ProxyId, S distance) {
        ++visits;
        return least = std::min(least, distance);
      });
    }
    EXPECT_LE(visits, 3000u);
  }
}

TYPED_TEST(Nearest, LimitsAreStrictAndNiceDistancesExact) {
  using S = TypeParam;
  Populated<S> p;
  p.create({{0, 0, 0}, {1, 1, 1}});
  p.create({{4, 5, 1}, {6, 6, 6}});  // 3, 4 and touching: 5
  p.create({{0, 0, 7}, {1, 1, 7}});  // 6, along one axis
  const auto count = [&](S limit) {
    std::size_t n = 0;
    p.world.query_nearest_box({{0, 0, 0}, {1, 1, 1}}, limit, [&](ProxyId, S) { return ++n, limit; });
    return n;
  };
  EXPECT_EQ(count(S(0)), 0u);
  EXPECT_EQ(count(std::numeric_limits<S>::denorm_min()), 1u);
  EXPECT_EQ(count(S(5)), 1u);
  EXPECT_EQ(count(std::nextafter(S(5), S(9))), 2u);
  EXPECT_EQ(count(S(6)), 2u);
  EXPECT_EQ(count(std::nextafter(S(6), S(9))), 3u);
}

#if defined(__SIZEOF_FLOAT128__)
__extension__ using Wide = __float128;
#else
using Wide = long double;
#endif

/// The exact distance, squared: 113 bits and exponents to spare.
template <class S>
Wide distance_squared(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  Wide sum = 0;
  for (int d = 0; d < 3; ++d) {
    Wide gap = 0;
    if (a.max[d] < b.min[d]) gap = static_cast<Wide>(b.min[d]) - a.max[d];
    if (b.max[d] < a.min[d]) gap = static_cast<Wide>(a.min[d]) - b.max[d];
    sum += gap * gap;
  }
  return sum;
}

TYPED_TEST(Nearest, BoundsAreBelowTheExactDistanceAndClose) {
  using S = TypeParam;
  constexpr S most = std::numeric_limits<S>::max();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> exponent(std::log2(std::numeric_limits<S>::denorm_min()) + 1,
                                                  std::log2(most) - 1);
  std::uniform_real_distribution<S> unit(-1, 1);
  const S wild[] = {S(1e-300), S(1e200), most, -most, std::numeric_limits<S>::denorm_min(), inf<S>, -inf<S>, 0};
  for (int i = 0; i < 200000; ++i) {
    BasicAabb<S> box[2];
    const double common = exponent(random);
    for (auto& b : box)
      for (int d = 0; d < 3; ++d) {
        const double e = i % 3 == 0 ? exponent(random) : common;
        S x = unit(random) * static_cast<S>(std::exp2(e)), y = unit(random) * static_cast<S>(std::exp2(e));
        if (i % 5 == 0 && random() % 3 == 0) x = wild[random() % 8];
        if (i % 5 == 0 && random() % 3 == 0) y = wild[random() % 8];
        if (i % 7 == 0) y = x;
        b.min[d] = std::min(x, y);
        b.max[d] = std::max(x, y);
      }
    const S below = detail::distance_below(box[0], box[1]);
    ASSERT_EQ(below, detail::distance_below(box[1], box[0]));
    ASSERT_GE(below, 0) << i;
    ASSERT_LE(below, most) << i;
    const Wide exact = distance_squared(box[0], box[1]);
    ASSERT_LE(static_cast<Wide>(below) * below, exact) << i;
    const Wide above = static_cast<Wide>(below) * (1 + 10 * static_cast<Wide>(std::numeric_limits<S>::epsilon())) +
                       2 * static_cast<Wide>(std::numeric_limits<S>::denorm_min());
    ASSERT_TRUE(below == most || above * above >= exact) << i;
  }
}

TYPED_TEST(Nearest, UnboundedAndInvalidBoxes) {
  using S = TypeParam;
  constexpr S most = std::numeric_limits<S>::max();
  Populated<S> p;
  p.create({{-inf<S>, -inf<S>, -inf<S>}, {inf<S>, inf<S>, 0}});  // a half-space
  p.create({{-most, -most, -most}, {most, most, 0}});            // the same, as FCL has it
  p.create({{5, 5, 2}, {6, 6, 3}});
  p.create({{nan<S>, 0, 0}, {1, 1, 1}});
  p.create({{2, 0, 0}, {1, 1, 1}});
  p.create({{inf<S>, 0, 0}, {inf<S>, 1, 1}});
  const Answer<S> keep = [](std::size_t, S, S limit) { return limit; };
  std::vector<S> distances;
  p.world.nearest_pairs(inf<S>, [&](ProxyPair, S distance) {
    distances.push_back(distance);
    return inf<S>;
  });
  // Half-spaces with each other and the far point with one of them; the box above them; the rest is out of sight.
  std::sort(distances.begin(), distances.end());
  EXPECT_EQ(distances, (std::vector<S>{0, 0, 2, 2, most, most}));
  compare_pairs<S>(p, inf<S>, keep, 0);
  compare_pairs<S>(p, most, keep, 0);
  compare_box_query<S>(p, {{0, 0, 7}, {1, 1, 8}}, inf<S>, keep, 0);
  compare_box_query<S>(p, {{nan<S>, 0, 7}, {1, 1, 8}}, inf<S>, keep, 0);
  compare_box_query<S>(p, {{2, 0, 7}, {1, 1, 8}}, inf<S>, keep, 0);
  compare_box_query<S>(p, {{-inf<S>, -inf<S>, -inf<S>}, {inf<S>, inf<S>, inf<S>}}, inf<S>, keep, 0);
}

TYPED_TEST(Nearest, QueriesInsideVisitorsAndExceptions) {
  using S = TypeParam;
  std::mt19937 random(2);
  Populated<S> p;
  for (int i = 0; i < 300; ++i) p.create(box_at<S>(random, 30, 2));
  const Answer<S> few = [](std::size_t k, S, S limit) { return k == 20 ? S(0) : limit; };
  std::size_t outer = 0;
  p.world.nearest_pairs(inf<S>, [&](ProxyPair pair, S distance) {
    S nearest = inf<S>;
    p.world.query_nearest_box(p.world.box(pair.a), inf<S>, [&](ProxyId id, S d) {
      if (id == pair.a) return nearest;
      compare_pairs<S>(p, inf<S>, few, 0);
      return nearest = d;
    });
    EXPECT_LE(nearest, distance);
    return ++outer < 30 ? inf<S> : S(0);
  });
  EXPECT_EQ(outer, 30u);
  for (const std::size_t fatal : {0, 1, 5, 64, 65, 1000}) {
    std::size_t k = 0;
    const auto visit = [&](auto, S) {
      if (k++ == fatal) throw std::runtime_error("stop");
      return inf<S>;
    };
    EXPECT_THROW(p.world.nearest_pairs(inf<S>, visit), std::runtime_error);
    k = 0;
    if (fatal < 300) {
      EXPECT_THROW(p.world.query_nearest_box(p.box(0), inf<S>, visit), std::runtime_error);
    }
    compare_pairs<S>(p, inf<S>, few, 0);
  }
}

}  // namespace boxstream::tests
