// SPDX-License-Identifier: MIT
// What boxstream's broad-phase offers beyond the interface it stands in for: options, planesTest, statistics.
#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <btBulletDynamicsCommon.h>
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

using boxstream::bullet::Broadphase;
using boxstream::bullet::Eager;
using boxstream::bullet::Options;

Broadphase* use(Rig& rig, const Options& options) {
  auto* broadphase = new Broadphase(options);
  rig.broadphase.reset(broadphase);
  return broadphase;
}

TEST(BulletOptions, P9_EagerAllMakesPairsAtOnce) {
  Rig rig;
  Options options;
  options.eager = Eager::all;
  use(rig, options);
  btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
  EXPECT_EQ(rig.pair_count(), 0);
  btBroadphaseProxy* b = rig.create(cube(0, 0, 0));
  EXPECT_TRUE(rig.holds(a, b));
  btBroadphaseProxy* c = rig.create(cube(20, 0, 0));
  rig.move(c, cube(0, btScalar(0.5), 0));
  EXPECT_TRUE(rig.holds(a, c));
  EXPECT_TRUE(rig.holds(b, c));
  const btCollisionAlgorithm* algorithm = rig.plant(a, c);
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 3);
  EXPECT_EQ(find_in_array(*rig.broadphase, a, c)->m_algorithm, algorithm);
  EXPECT_EQ(rig.pairs(), sorted(rig.pairs()));
  rig.move(c, cube(20, 0, 0));
  rig.calculate();
  EXPECT_EQ(rig.pair_count(), 1);
  EXPECT_EQ(rig.algorithms_destroyed, 1);
}

TEST(BulletOptions, P9_EagerNoneNeverLooksAtClients) {
  for (const bool external : {false, true}) {
    btHashedOverlappingPairCache cache;
    Rig rig;
    Options options;
    options.eager = Eager::none;
    rig.broadphase = std::make_unique<Broadphase>(external ? &cache : nullptr, options);
    GhostLog log;
    rig.cache().setInternalGhostPairCallback(&log);
    rig.create_for(reinterpret_cast<btCollisionObject*>(17), cube(0, 0, 0));
    btBroadphaseProxy* b = rig.create_for(reinterpret_cast<btCollisionObject*>(18), cube(5, 0, 0));
    rig.move(b, cube(0, 0, 0));
    EXPECT_EQ(rig.pair_count(), 0);
    rig.calculate();
    EXPECT_EQ(rig.pair_count(), 1);
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

TEST(BulletOptions, P11_MarginWidensTheSearchForPairsOnly) {
  Rig rig;
  Options options;
  options.margin = btScalar(0.05);
  use(rig, options);
  btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
  btBroadphaseProxy* b = rig.create(cube(btScalar(1.09), 0, 0));
  btBroadphaseProxy* c = rig.create(cube(btScalar(-1.11), 0, 0));
  rig.calculate();
  EXPECT_TRUE(rig.holds(a, b));
  EXPECT_FALSE(rig.holds(a, c));
  btVector3 lo, hi;
  rig.broadphase->getAabb(b, lo, hi);
  EXPECT_EQ(lo, cube(btScalar(1.09), 0, 0).lo);
  EXPECT_EQ(b->m_aabbMax, cube(btScalar(1.09), 0, 0).hi);
  for (const int others : {0, 20}) {  // very few are looked at one by one
    for (int i = 0; i < others; ++i) rig.create(cube(0, 0, btScalar(50 + 2 * i)));
    for (const btScalar z : {btScalar(1.04), btScalar(1)}) {
      const std::size_t found = rig.in_box(cube(0, 0, z)).size();
      EXPECT_EQ(found, z == 1 ? 1u : 0u) << "what is within the margin of a box is not in the box; " << others;
    }
  }
  GhostLog log;
  rig.cache().setInternalGhostPairCallback(&log);
  btPairCachingGhostObject ghost;
  btBroadphaseProxy* at_ghost = rig.create_for(&ghost, cube(0, btScalar(1.09), 0));
  EXPECT_TRUE(rig.holds(a, at_ghost));
  rig.cache().setInternalGhostPairCallback(nullptr);
}

TEST(BulletOptions, PlanesTestCullsByFrustum) {
  Rig rig;
  Broadphase* broadphase = use(rig, {});
  Random random(77);
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 500; ++i) {
    const btVector3 p = random.vector(-10, 10);
    proxies.push_back(rig.create(cube(p.x(), p.y(), p.z(), random.real(0, 1))));
  }
  for (int count = 0; count <= 6; ++count) {
    std::vector<btVector3> normals;
    std::vector<btScalar> offsets;
    for (int i = 0; i < count; ++i) {
      normals.push_back(random.vector(-1, 1));
      offsets.push_back(random.real(-1, 4));
    }
    Found found;
    broadphase->planesTest(normals.data(), offsets.data(), count, found);
    std::vector<const btBroadphaseProxy*> wanted;
    for (const btBroadphaseProxy* proxy : proxies) {
      bool inside = true;
      for (std::size_t i = 0; i < normals.size(); ++i) {
        btVector3 furthest;
        for (int d = 0; d < 3; ++d) furthest[d] = normals[i][d] > 0 ? proxy->m_aabbMax[d] : proxy->m_aabbMin[d];
        inside = inside && normals[i].dot(furthest) + offsets[i] >= 0;
      }
      if (inside) wanted.push_back(proxy);
    }
    EXPECT_EQ(sorted(found.proxies), sorted(wanted)) << count << " planes";
  }
}

std::vector<int> dbvt_finds(Rig& rig, const std::vector<btVector3>& normals, const std::vector<btScalar>& offsets) {
  struct : btDbvt::ICollide {
    std::vector<int> uids;
    void Process(const btDbvtNode* leaf) override {
      uids.push_back(static_cast<btBroadphaseProxy*>(leaf->data)->m_uniqueId);
    }
  } found;
  for (const btDbvt& tree : static_cast<btDbvtBroadphase&>(*rig.broadphase).m_sets)
    btDbvt::collideKDOP(tree.m_root, normals.data(), offsets.data(), int(normals.size()), found);
  return found.uids;
}

/// Small whole numbers, so that Bullet's sums are exact too.
TEST(BulletOptions, PlanesTestFindsWhatDbvtFinds) {
  constexpr btScalar inf = std::numeric_limits<btScalar>::infinity(), nan = std::numeric_limits<btScalar>::quiet_NaN();
  constexpr btScalar large = BT_LARGE_FLOAT, most = std::numeric_limits<btScalar>::max();
  for (const btScalar margin : {btScalar(0), btScalar(0.5)}) {
    Rig rig, dbvt(Kind::dbvt);
    Options options;
    options.margin = margin;
    const Broadphase* broadphase = use(rig, options);
    Random random(78);
    std::vector<btBroadphaseProxy*> ours, theirs, special;
    for (int i = 0; i < 2000; ++i) {
      const Box box = cube(btScalar(random.below(64)), btScalar(random.below(64)), btScalar(random.below(64)));
      ours.push_back(rig.create(box));
      theirs.push_back(dbvt.create(box));
    }
    for (const Box& box :
         {Box{btVector3(-inf, -inf, -inf), btVector3(inf, inf, inf)},
          Box{btVector3(-inf, -5, -inf), btVector3(inf, -4, inf)}, Box{btVector3(3, 3, -inf), btVector3(4, 4, 9)},
          Box{btVector3(3, inf, 3), btVector3(4, inf, 4)},
          Box{btVector3(-large, -large, -large), btVector3(large, 0, large)},
          Box{btVector3(-most, -most, -most), btVector3(most, most, most)},
          Box{btVector3(most, 0, 0), btVector3(most, 1, 1)}, Box{btVector3(nan, 0, 0), btVector3(1, 1, 1)},
          Box{btVector3(2, 2, 2), btVector3(1, 3, 3)}})
      special.push_back(rig.create(box));
    for (int round = 0; round < 60; ++round) {
      const int count = round % 31;  // Dbvt shifts an int by that many bits
      std::vector<btVector3> normals;
      std::vector<btScalar> offsets;
      for (int i = 0; i < count; ++i) {
        normals.push_back(
            btVector3(btScalar(random.below(9) - 4), btScalar(random.below(9) - 4), btScalar(random.below(9) - 4)));
        offsets.push_back(btScalar(random.below(500) - 50));
      }
      Found found;
      broadphase->planesTest(normals.data(), offsets.data(), count, found);
      std::vector<int> uids;
      std::vector<const btBroadphaseProxy*> found_special;
      for (const btBroadphaseProxy* proxy : found.proxies)
        if (proxy->m_uniqueId <= 2000)
          uids.push_back(proxy->m_uniqueId);
        else
          found_special.push_back(proxy);
      ASSERT_EQ(sorted(uids), sorted(dbvt_finds(dbvt, normals, offsets))) << "round " << round;

      std::vector<const btBroadphaseProxy*> wanted;
      for (const btBroadphaseProxy* proxy : special) {
        const btVector3 &lo = proxy->m_aabbMin, &hi = proxy->m_aabbMax;
        bool inside = lo.x() <= hi.x() && lo.y() <= hi.y() && lo.z() <= hi.z();
        for (std::size_t i = 0; i < normals.size(); ++i) {
          const btVector3& n = normals[i];
          inside = inside && !boxstream::is_behind<btScalar>({{lo.x(), lo.y(), lo.z()}, {hi.x(), hi.y(), hi.z()}},
                                                             {{n.x(), n.y(), n.z()}, offsets[i]});
        }
        if (inside) wanted.push_back(proxy);
      }
      ASSERT_EQ(sorted(found_special), sorted(wanted)) << "round " << round;
      ASSERT_EQ(
          std::count(wanted.begin(), wanted.end(), special[0]),
          std::none_of(normals.begin(), normals.end(),
                       [&](const btVector3& n) { return n.isZero() && offsets[std::size_t(&n - normals.data())] < 0; }))
          << "a box of everything";
    }
  }
}

TEST(BulletOptions, StatsTellWhatTheLastCalculateDid) {
  Rig rig;
  const Broadphase* broadphase = use(rig, {});
  btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
  rig.create(cube(0, 0, 0));
  rig.calculate();
  EXPECT_EQ(broadphase->stats().proxies, 2u);
  EXPECT_EQ(broadphase->stats().pairs, 1u);
  EXPECT_EQ(broadphase->stats().begun, 1u);
  rig.move(a, cube(9, 0, 0));
  rig.calculate();
  EXPECT_EQ(broadphase->stats().moved, 1u);
  EXPECT_EQ(broadphase->stats().ended, 1u);
  EXPECT_EQ(broadphase->stats().pairs, 0u);
}

TEST(BulletOptions, P13_ExecutorDoesNotChangeResults) {
  struct Backwards : boxstream::Executor {  // an order that no serial loop would take
    unsigned concurrency() const override { return 4; }
    void parallel_for(std::size_t count, boxstream::FunctionRef<void(std::size_t)> task) override {
      ++loops;
      for (std::size_t i = count; i-- > 0;) task(i);
    }
    int loops = 0;
  } executor;
  std::vector<std::vector<UidPair>> runs[2];
  for (int r = 0; r < 2; ++r) {
    Rig rig;
    Options options;
    if (r == 1) options.executor = &executor;
    use(rig, options);
    Random random(13);
    std::vector<btBroadphaseProxy*> proxies;
    for (int i = 0; i < 20000; ++i) proxies.push_back(rig.create(cube(0, 0, btScalar(i))));
    for (int frame = 0; frame < 3; ++frame) {
      for (btBroadphaseProxy* proxy : proxies) {
        const btVector3 p = random.vector(-22, 22);
        rig.move(proxy, cube(p.x(), p.y(), p.z()));
      }
      rig.calculate();
      runs[r].push_back(rig.pairs());
    }
  }
  EXPECT_GT(runs[0][0].size(), 1000u);
  EXPECT_EQ(runs[0], runs[1]);
  EXPECT_GE(executor.loops, 3);
}

/// A world on the paper's tree: the same pairs in each step, and so the same motion to the bit.
TEST(BulletOptions, HybridWorldMovesAsAPlannedOne) {
  struct Pile {
    explicit Pile(const Options& options) : broadphase(options) {
      body(0, ground, btVector3(0, -1, 0));
      for (int i = 0; i < 160; ++i)
        body(1, box, btVector3(btScalar(i % 5) - 2 + btScalar(i % 3) / 10, btScalar(i / 10) + 1, btScalar(i / 5 % 2)));
    }
    ~Pile() {
      for (const auto& one : bodies) world.removeRigidBody(one.get());
    }
    void body(btScalar mass, btBoxShape& shape, const btVector3& at) {
      btVector3 inertia(0, 0, 0);
      if (mass > 0) shape.calculateLocalInertia(mass, inertia);
      bodies.push_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
      bodies.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
      world.addRigidBody(bodies.back().get());
    }

    btBoxShape ground{btVector3(50, 1, 50)}, box{btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5))};
    btDefaultCollisionConfiguration config;
    btCollisionDispatcher dispatcher{&config};
    Broadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    std::vector<std::unique_ptr<btRigidBody>> bodies;
    btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &config};
  };
  Options sampled, fine;
  sampled.method = fine.method = Method::hybrid;
  fine.cutoff = 8;
  Pile planned{Options()}, hybrid(sampled), small(fine);
  std::size_t pairs = 0;
  for (int step = 0; step < 120; ++step) {
    for (Pile* pile : {&planned, &hybrid, &small}) pile->world.stepSimulation(btScalar(1) / 60, 0);
    const auto expected = pairs_of(planned.broadphase);
    ASSERT_EQ(pairs_of(hybrid.broadphase), expected) << step;
    ASSERT_EQ(pairs_of(small.broadphase), expected) << step;
    EXPECT_EQ(hybrid.broadphase.stats().search.boxes, 161u) << "a batch in each step";
    EXPECT_GT(small.broadphase.stats().search.nodes, 5u);
    pairs += expected.size();
    for (std::size_t i = 0; i < planned.bodies.size(); ++i)
      ASSERT_EQ(hybrid.bodies[i]->getWorldTransform(), planned.bodies[i]->getWorldTransform()) << step;
  }
  EXPECT_GT(pairs, 10000u);
}

TEST(BulletOptions, DbvtMembersThatProgramsCall) {
  Broadphase broadphase;
  btCollisionObject client;
  const Box box = cube(0, 0, 0), moved = cube(3, 0, 0);
  btBroadphaseProxy* proxy = broadphase.createProxy(box.lo, box.hi, BOX_SHAPE_PROXYTYPE, &client, 1, -1, nullptr);
  broadphase.setAabbForceUpdate(proxy, moved.lo, moved.hi, nullptr);
  EXPECT_EQ(proxy->m_aabbMin, moved.lo);
  broadphase.optimize();
  broadphase.setVelocityPrediction(1);
  EXPECT_EQ(broadphase.getVelocityPrediction(), 0);
}

}  // namespace
}  // namespace boxstream::bullet_test
