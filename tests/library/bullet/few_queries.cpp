// SPDX-License-Identifier: MIT
// Queries of few proxies, which are compared with each, find what queries of the World find.
#include <algorithm>
#include <limits>
#include <vector>

#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

constexpr btScalar inf = std::numeric_limits<btScalar>::infinity(), nan = std::numeric_limits<btScalar>::quiet_NaN();

/// On integers, so that rays graze boxes; some reach to infinity, are none, or have the fourth number of anybody.
Box odd_box(Random& random) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = btScalar(random.below(7) - 3);
    box.hi[axis] = box.lo[axis] + btScalar(random.below(4));
    if (box.lo[axis] == 0 && random.below(2)) box.lo[axis] = -btScalar(0);
    if (random.below(30) == 0) box.lo[axis] = -inf;
    if (random.below(30) == 0) box.hi[axis] = inf;
    if (random.below(60) == 0) box.hi[axis] = nan;
    if (random.below(60) == 0) box.hi[axis] = box.lo[axis] - 1;
    if (random.below(60) == 0) box.hi[axis] = std::numeric_limits<btScalar>::max();
  }
  box.lo[3] = box.hi[3] = random.below(3) ? btScalar(0) : random.below(2) ? nan : btScalar(-9);
  return box;
}

struct OddRay {
  explicit OddRay(Random& random) {
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = btScalar(random.below(13) - 6);
      to[axis] = btScalar(random.below(9) - 4);
    }
    if (random.below(2)) {
      for (int axis = 0; axis < 3; ++axis) high[axis] = btScalar(random.below(3)) / 2;
      if (random.below(8) == 0) low[random.below(3)] = 2;  // no box
    }
    callback = FoundOnRay(from, to, random.below(2) ? btScalar(BT_LARGE_FLOAT) : inf);
    constexpr btScalar odd[] = {
        nan, inf, -inf, 0, -1, std::numeric_limits<btScalar>::max(), std::numeric_limits<btScalar>::denorm_min()};
    const auto one_of = [&] { return odd[random.below(int(std::size(odd)))]; };
    if (random.below(10) == 0) callback.m_rayDirectionInverse[random.below(3)] = one_of();
    if (random.below(10) == 0) callback.m_lambda_max = one_of();
    if (random.below(20) == 0) from[random.below(3)] = one_of();
    if (random.below(20) == 0) high[random.below(3)] = one_of();
  }
  btVector3 from{0, 0, 0}, to{0, 0, 0}, low{0, 0, 0}, high{0, 0, 0};
  FoundOnRay callback{from, to};
};

/// Places of the first ones of `proxies` that were found.
std::vector<int> places(const std::vector<const btBroadphaseProxy*>& found,
                        const std::vector<btBroadphaseProxy*>& proxies, int count) {
  std::vector<int> places;
  for (int i = 0; i < count; ++i)
    if (std::count(found.begin(), found.end(), proxies[std::size_t(i)]) != 0) places.push_back(i);
  return places;
}

TEST(BulletFewQueries, FindWhatTheWorldFinds) {
  Random random(5);
  std::size_t on_rays = 0, in_boxes = 0;
  for (int count = 1; count <= 12; ++count) {
    Rig few, many;
    std::vector<btBroadphaseProxy*> of_few, of_many;
    for (int i = 0; i < count + 60; ++i) {
      const Box box = odd_box(random);
      if (i < count) of_few.push_back(few.create(box));
      of_many.push_back(many.create(box));
    }
    for (int i = 0; i < 400; ++i) {
      const OddRay ray(random);
      FoundOnRay in_few = ray.callback, in_many = ray.callback;
      few.broadphase->rayTest(ray.from, ray.to, in_few, ray.low, ray.high);
      many.broadphase->rayTest(ray.from, ray.to, in_many, ray.low, ray.high);
      ASSERT_EQ(places(in_few.proxies, of_few, count), places(in_many.proxies, of_many, count)) << count << ' ' << i;
      ASSERT_TRUE(std::is_sorted(in_few.proxies.begin(), in_few.proxies.end(),
                                 [](auto* a, auto* b) { return a->m_uniqueId < b->m_uniqueId; }));
      on_rays += in_few.proxies.size();
      const Box box = odd_box(random);
      const auto found = few.in_box(box);
      ASSERT_EQ(places(found, of_few, count), places(many.in_box(box), of_many, count)) << count << ' ' << i;
      in_boxes += found.size();
    }
  }
  EXPECT_GT(on_rays, 1000u);
  EXPECT_GT(in_boxes, 2000u);
}

}  // namespace
}  // namespace boxstream::bullet_test
