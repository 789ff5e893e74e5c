// SPDX-License-Identifier: MIT
// Queries whose callbacks let others of the same thread go on: many are half way at once, and the first to begin is not
// the last to end.
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

#include "fibres.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

struct Query {
  Box box;
  btVector3 from, to;
  int kind;  // 0: box, 1: ray, 2: planes
};

/// What it is called back with, in order.
std::vector<const btBroadphaseProxy*> ask(Rig& rig, const Query& query,
                                          const std::function<void(const btBroadphaseProxy*)>& meanwhile) {
  Found found;
  FoundOnRay on_ray(query.from, query.to);
  found.also = on_ray.also = meanwhile;
  const btVector3 normals[] = {{1, 0, 0}, {-1, 0, 0}};
  const btScalar offsets[] = {-query.box.lo.x(), query.box.hi.x()};
  if (query.kind == 0) rig.broadphase->aabbTest(query.box.lo, query.box.hi, found);
  if (query.kind == 1) rig.broadphase->rayTest(query.from, query.to, on_ray);
  if (query.kind == 2)
    static_cast<boxstream::bullet::Broadphase&>(*rig.broadphase).planesTest(normals, offsets, 2, found);
  return query.kind == 1 ? on_ray.proxies : found.proxies;
}

TEST(BulletFibres, Q10_QueriesThatEndInAnyOrder) {
  Rig rig;
  rig.broadphase = std::make_unique<boxstream::bullet::Broadphase>();
  Random random(90);
  for (int i = 0; i < 500; ++i) {
    const btVector3 p = random.vector(-6, 6);
    rig.create(cube(p.x(), p.y(), p.z()));
  }
  std::vector<Query> queries;
  for (int i = 0; i < 60; ++i) {
    const btVector3 p = random.vector(-6, 6), from = random.vector(-9, 9), to = random.vector(-9, 9);
    queries.push_back({cube(p.x(), p.y(), p.z(), random.real(0, 3)), from, to, i % 3});
  }
  std::vector<std::vector<const btBroadphaseProxy*>> alone, together(queries.size());
  std::size_t longest = 0, shortest = 500;
  for (const Query& query : queries) {
    alone.push_back(ask(rig, query, {}));
    longest = std::max(longest, alone.back().size());
    shortest = std::min(shortest, alone.back().size());
  }
  ASSERT_GT(longest, 100u);
  ASSERT_LT(shortest, 10u);
  boxstream::tests::Fibres fibres;
  const auto yield = [&](const btBroadphaseProxy*) { fibres.yield(); };
  for (std::size_t first = 0; first < queries.size(); first += 4)  // one after the other on each fibre
    fibres.add([&, first] {
      for (std::size_t i = first; i < first + 4; ++i) together[i] = ask(rig, queries[i], yield);
    });
  fibres.run();
  EXPECT_GT(fibres.yields(), 1000u);
  for (std::size_t i = 0; i < queries.size(); ++i) EXPECT_EQ(together[i], alone[i]) << "query " << i;
}

}  // namespace
}  // namespace boxstream::bullet_test
