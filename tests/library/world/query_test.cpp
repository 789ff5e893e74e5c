// SPDX-License-Identifier: MIT
// Queries in worlds large enough for a deep index, against brute force, through refits, evictions and rebuilds.
#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include <boxstream/world.hpp>

#include "model.hpp"
#include "values.hpp"

namespace boxstream::tests {

template <class S>
class Queries : public ::testing::Test {
 public:
  using Box = BasicAabb<S>;

  Box random_box(S side) {
    std::uniform_real_distribution<S> place(-50, 50);
    const S x = place(random_);
    const S y = place(random_);
    const S z = place(random_) / 10;
    return {{x, y, z}, {x + side, y + side, z + side}};
  }

  void create(const Box& box) { model_.create(world_.create(box), box, {}, 0); }

  void move(Birth b, const Box& box) {
    if (!model_.proxies()[b].alive) return;
    ASSERT_TRUE(world_.move(model_.proxies()[b].id, box));
    model_.proxies()[b].box = box;
  }

  void compare_some_queries() {
    for (int i = 0; i < 10; ++i) {
      const Box box = random_box(S(2 + i));
      std::vector<Birth> in_box;
      world_.query_box(box, [&](ProxyId id) {
        in_box.push_back(model_.birth(id));
        return true;
      });
      std::sort(in_box.begin(), in_box.end());
      ASSERT_EQ(in_box, model_.in_box(box));

      const Box other = random_box(1);
      const S step[3] = {other.min[0] - box.min[0], other.min[1] - box.min[1], i % 3 == 0 ? S(0) : other.min[2]};
      BasicRay<S> ray = BasicRay<S>::along(box.min, step, 1);
      if (i % 2 == 0) ray = BasicRay<S>::sweep(box, step);
      std::map<Birth, S> on_ray;
      world_.query_ray(ray, [&](ProxyId id, S enter, S length) {
        on_ray[model_.birth(id)] = enter;
        return length;
      });
      const auto expected = model_.on_ray(ray);
      ASSERT_EQ(on_ray, expected);

      // Clipping at each hit must end at the nearest one.
      S nearest = ray.length;
      bool hit = false;
      world_.query_ray(ray, [&](ProxyId, S enter, S length) {
        EXPECT_LE(enter, length);
        hit = true;
        return nearest = enter;
      });
      ASSERT_EQ(hit, !expected.empty());
      for (const auto& [b, enter] : expected) ASSERT_LE(nearest, enter);

      std::vector<ProxyId> near(i == 0 ? 3 * model_.proxies().size() : 1u << i % 8);
      near.resize(world_.query_nearest(box.max, Span<ProxyId>(near)));
      std::vector<Birth> births;
      for (const ProxyId id : near) births.push_back(model_.birth(id));
      ASSERT_EQ(births, model_.nearest(box.max, i == 0 ? 3 * model_.proxies().size() : 1u << i % 8));
    }
  }

  // Public, for the thread that gets a pointer to the test.
  std::mt19937 random_{11};
  BasicWorld<S> world_;
  Model<S> model_{false};
};

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Queries, Scalars);

TYPED_TEST(Queries, ExactThroughAllKindsOfChange) {
  using S = TypeParam;
  std::uniform_real_distribution<S> step(S(-0.1), S(0.1));
  this->compare_some_queries();
  for (int i = 0; i < 2500; ++i) this->create(this->random_box(S(0.2) + S(i % 10) / 5));
  const S inf = std::numeric_limits<S>::infinity();
  for (int i = 0; i < 5; ++i) {  // planes, half-spaces and everything
    this->create({{S(-1e18), S(-1e18), S(-1e18)}, {S(1e18), S(1e18), S(i)}});
    this->create({{-inf, -inf, -inf}, {inf, S(i * 10), inf}});
    this->create({{-inf, -inf, -inf}, {inf, inf, inf}});
  }
  this->compare_some_queries();
  this->world_.validate();
  const auto jitter = [&](Birth b) {
    auto box = this->model_.proxies()[b].box;
    for (int d = 0; d < 3; ++d) {
      const S by = step(this->random_);
      box.min[d] += by;
      box.max[d] += by;
    }
    this->move(b, box);
  };
  for (int frame = 0; frame < 12; ++frame) {
    const std::size_t n = this->model_.proxies().size();
    switch (frame % 4) {
      case 0:
        for (Birth b = 0; b < n; ++b) jitter(b);
        break;
      case 1:
        for (Birth b = 0; b < n; b += 50) jitter(b);
        break;
      case 2:  // teleports, which leave their neighbours behind
        for (Birth b = static_cast<Birth>(frame); b < n; b += 40) this->move(b, this->random_box(1));
        break;
      case 3:
        for (Birth b = static_cast<Birth>(frame); b < n; b += 30)
          if (this->model_.proxies()[b].alive) {
            this->world_.destroy(this->model_.proxies()[b].id);
            this->model_.destroy(b);
            this->create(this->random_box(1));
          }
        break;
    }
    this->compare_some_queries();
    ASSERT_FALSE(this->HasFatalFailure());
    this->world_.validate();
  }
}

TYPED_TEST(Queries, VisitorsStopAtOnce) {
  using S = TypeParam;
  for (int i = 0; i < 100; ++i) this->create({{0, 0, 0}, {1, 1, 1}});
  int seen = 0;
  this->world_.query_box({{0, 0, 0}, {1, 1, 1}}, [&](ProxyId) { return ++seen < 3; });
  EXPECT_EQ(seen, 3);
  seen = 0;
  const S origin[3] = {0, 0, 0};
  const S direction[3] = {1, 0, 0};
  this->world_.query_ray(BasicRay<S>::along(origin, direction, 5),
                         [&](ProxyId, S, S length) { return ++seen < 3 ? length : S(-1); });
  EXPECT_EQ(seen, 3);
}

TYPED_TEST(Queries, RaysAreClosedAndEdgeCasesAreDefined) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  const S nan = std::numeric_limits<S>::quiet_NaN();
  this->create({{1, 1, 1}, {2, 2, 2}});
  const auto hits = [&](S x, S y, S z, S dx, S dy, S dz, S length) {
    const S origin[3] = {x, y, z};
    const S direction[3] = {dx, dy, dz};
    int count = 0;
    this->world_.query_ray(BasicRay<S>::along(origin, direction, length), [&](ProxyId, S enter, S l) {
      EXPECT_GE(enter, 0);
      ++count;
      return l;
    });
    return count == 1;
  };
  EXPECT_TRUE(hits(0, 1, 1, 1, 0, 0, 1)) << "along an edge, ending on a corner";
  EXPECT_TRUE(hits(0, 2, 2, 1, 0, 0, inf)) << "along the opposite edge";
  EXPECT_FALSE(hits(0, std::nextafter(S(2), S(3)), 2, 1, 0, 0, inf));
  EXPECT_FALSE(hits(0, 1, 1, 1, 0, 0, std::nextafter(S(1), S(0))));
  EXPECT_TRUE(hits(2, 2, 2, 1, 1, 1, 5)) << "starting on a corner and leaving";
  EXPECT_FALSE(hits(3, 1, 1, 1, 0, 0, inf)) << "behind the start";
  EXPECT_TRUE(hits(3, 1, 1, -1, 0, -S(0), inf));
  EXPECT_TRUE(hits(1, 1, 1, 0, 0, 0, 0)) << "zero length inside";
  EXPECT_FALSE(hits(0, 1, 1, 0, 0, 0, 0));
  EXPECT_FALSE(hits(0, 1, 1, 1, 0, 0, -1)) << "negative length";
  for (int field = 0; field < 13; ++field) {
    BasicRay<S> ray{{0, 1, 1}, {1, inf, inf}, 9};
    S* const fields[] = {&ray.origin[0],
                         &ray.origin[1],
                         &ray.origin[2],
                         &ray.inverse_direction[0],
                         &ray.inverse_direction[1],
                         &ray.inverse_direction[2],
                         &ray.length,
                         &ray.extent_min[0],
                         &ray.extent_min[1],
                         &ray.extent_min[2],
                         &ray.extent_max[0],
                         &ray.extent_max[1],
                         &ray.extent_max[2]};
    *fields[field] = nan;
    this->world_.query_ray(ray, [&](ProxyId, S, S l) {
      ADD_FAILURE() << "NaN in field " << field;
      return l;
    });
  }
}

// Differences of infinities are no numbers, and are ignored.
TYPED_TEST(Queries, RaysFromInfinityAndSweepsOfAllSpace) {
  using S = TypeParam;
  const S inf = std::numeric_limits<S>::infinity();
  this->create({{-inf, 1, 1}, {2, 2, 2}});
  this->create({{inf, 1, 1}, {inf, 2, 2}});
  const BasicRay<S> from_infinity{{-inf, 1, 1}, {1, inf, inf}, 1};
  const BasicRay<S> all_space = BasicRay<S>::sweep({{-inf, -inf, -inf}, {inf, inf, inf}}, {1, 0, 0});
  for (const int others : {0, 300}) {
    for (int i = 0; i < others; ++i) this->create({{S(i), 5, 5}, {S(i + 1), 6, 6}});
    const auto hits = [&](const BasicRay<S>& ray) {
      std::vector<Birth> births;
      this->world_.query_ray(ray, [&](ProxyId id, S, S length) {
        births.push_back(this->model_.birth(id));
        return length;
      });
      std::sort(births.begin(), births.end());
      return births;
    };
    EXPECT_EQ(hits(from_infinity), std::vector<Birth>{0});
    EXPECT_EQ(hits(all_space).size(), 2u + static_cast<unsigned>(others));
  }
}

TYPED_TEST(Queries, InvalidBoxesFindNothing) {
  using S = TypeParam;
  this->create({{0, 0, 0}, {9, 9, 9}});
  for (int side = 0; side < 6; ++side) {
    for (const S bound : {side < 3 ? S(8) : S(1), std::numeric_limits<S>::quiet_NaN()}) {
      BasicAabb<S> box{{2, 2, 2}, {3, 3, 3}};
      (side < 3 ? box.min : box.max)[side % 3] = bound;
      int found = 0;
      this->world_.query_box(box, [&](ProxyId) { return ++found > 0; });
      EXPECT_EQ(found, 0) << "side " << side << " at " << bound;
    }
  }
}

TYPED_TEST(Queries, NestedQueriesFromInsideVisitors) {
  using S = TypeParam;
  for (int i = 0; i < 600; ++i) this->create(this->random_box(2));
  const typename TestFixture::Box all{{-60, -60, -60}, {60, 60, 60}};
  std::size_t outer = 0;
  this->world_.query_box(all, [&](ProxyId id) {
    const auto box = this->world_.box(id);
    std::size_t inner = 0;
    this->world_.query_ray(BasicRay<S>::sweep(box, {0, 0, 0}), [&](ProxyId, S, S length) {
      std::size_t innermost = 0;
      this->world_.query_box(box, [&](ProxyId) { return ++innermost > 0; });
      EXPECT_GT(innermost, 0u);
      ++inner;
      return length;
    });
    EXPECT_EQ(inner, this->model_.in_box(box).size());
    return ++outer > 0;
  });
  EXPECT_EQ(outer, 600u);
}

// One proxy at a time, with a query after each: must not rebuild each time.
TYPED_TEST(Queries, AlternatingWithCreationStaysCheap) {
  const typename TestFixture::Box all{{-60, -60, -60}, {60, 60, 60}};
  for (int i = 0; i < 10000; ++i) {
    const ProxyId id = this->world_.create(this->random_box(1));
    bool seen = false;
    this->world_.query_box(this->world_.box(id), [&](ProxyId found) { return !(seen = seen || found == id); });
    ASSERT_TRUE(seen);
  }
  std::size_t count = 0;
  this->world_.query_box(all, [&](ProxyId) { return ++count > 0; });
  EXPECT_EQ(count, 10000u);
  this->world_.validate();
}

TYPED_TEST(Queries, FitOnASmallStack) {
  for (int i = 0; i < 5000; ++i) this->create(this->random_box(1));
  this->compare_some_queries();
  const auto work = [](void* self) -> void* {
    auto& test = *static_cast<Queries<TypeParam>*>(self);
    using S = TypeParam;
    const S point[3] = {0, 0, 0};
    ProxyId near[20];
    EXPECT_EQ(test.world_.query_nearest(point, near), 20u);
    std::size_t count = 0;
    test.world_.query_box({{-60, -60, -60}, {60, 60, 60}}, [&](ProxyId id) {
      if (count % 100 == 0)
        test.world_.query_ray(BasicRay<S>::sweep(test.world_.box(id), {1, 2, 3}), [](ProxyId, S, S l) { return l; });
      return ++count > 0;
    });
    EXPECT_EQ(count, 5000u);
    return nullptr;
  };
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 64 * 1024), 0);
  pthread_t thread;
  ASSERT_EQ(pthread_create(&thread, &attributes, work, this), 0);
  EXPECT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
}

TYPED_TEST(Queries, NearestBreaksTiesByCreation) {
  using S = TypeParam;
  std::vector<ProxyId> ids;
  for (int i = 0; i < 40; ++i) {
    this->create({{1, 1, 1}, {2, 2, 2}});
    ids.push_back(this->model_.proxies().back().id);
  }
  const S point[3] = {0, 0, 0};
  ProxyId out[15];
  ASSERT_EQ(this->world_.query_nearest(point, out), 15u);
  EXPECT_TRUE(std::equal(out, out + 15, ids.begin()));
  EXPECT_EQ(this->world_.query_nearest(point, {}), 0u);
}

}  // namespace boxstream::tests
