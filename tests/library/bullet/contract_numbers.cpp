// SPDX-License-Identifier: MIT
// Sections 7 and 12 of the contract: margins, hard numbers, precision.
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <limits>

#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

constexpr btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();
constexpr btScalar inf = std::numeric_limits<btScalar>::infinity();

TEST(BulletContract, S7_GapAfterSmallMoveTeleportAndCreation) {
  struct Row {
    Kind kind;
    bool small_move, teleport, create;
  };
  for (const Row row : {Row{Kind::dbvt, true, false, false},
                        {Kind::axis16, true, true, true},
                        {Kind::axis32, false, false, false},
                        {Kind::simple, false, false, false},
                        {Kind::subject, false, false, false}}) {
    const btScalar gap = btScalar(1.001);  // between centres of unit cubes
    {
      Rig rig(row.kind);
      rig.create(cube(0, 0, 0));
      btBroadphaseProxy* mover = rig.create(cube(btScalar(1.1), 0, 0));
      rig.move(mover, cube(gap, 0, 0));
      rig.calculate();
      EXPECT_EQ(rig.pair_count(), row.small_move) << row.kind;
    }
    {
      Rig rig(row.kind);
      rig.create(cube(0, 0, 0));
      btBroadphaseProxy* mover = rig.create(cube(50, 0, 0));
      rig.move(mover, cube(gap, 0, 0));
      rig.calculate();
      EXPECT_EQ(rig.pair_count(), row.teleport) << row.kind;
    }
    {
      Rig rig(row.kind);
      rig.create(cube(0, 0, 0));
      rig.create(cube(gap, 0, 0));
      rig.calculate();
      EXPECT_EQ(rig.pair_count(), row.create) << row.kind;
    }
  }
}

TEST(BulletContract, D1_TheWorldAddsItsMarginAndWeAddNone) {
  // Each box grows by 0.02, so bodies pair at a gap of up to 0.04.
  for (const Kind kind : {Kind::simple, Kind::subject}) {
    for (const bool near : {true, false}) {
      Rig rig(kind);
      btSequentialImpulseConstraintSolver solver;
      btDiscreteDynamicsWorld world(&rig.dispatcher, rig.broadphase.get(), &solver, &rig.config);
      world.setGravity(btVector3(0, 0, 0));
      btBoxShape box(btVector3(1, 1, 1));
      btRigidBody a(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &box, btVector3(1, 1, 1)));
      btRigidBody b(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &box, btVector3(1, 1, 1)));
      const btScalar gap = near ? btScalar(0.039) : btScalar(0.041);
      b.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(2 + gap, 0, 0)));
      b.setInterpolationWorldTransform(b.getWorldTransform());
      world.addRigidBody(&a);
      world.addRigidBody(&b);
      world.performDiscreteCollisionDetection();
      EXPECT_EQ(rig.pair_count(), near) << kind;
      world.removeRigidBody(&a);
      world.removeRigidBody(&b);
    }
  }
}

TEST(BulletContract, D3_OverflowingObjectsKeepTheirOldBoxAndPairs) {
  for (const bool not_a_number : {false, true})
    for (const Kind kind : {Kind::dbvt, Kind::subject}) {
      Rig rig(kind);
      btSequentialImpulseConstraintSolver solver;
      btDiscreteDynamicsWorld world(&rig.dispatcher, rig.broadphase.get(), &solver, &rig.config);
      world.setGravity(btVector3(0, 0, 0));
      btSphereShape sphere(1);
      btRigidBody a(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &sphere, btVector3(1, 1, 1)));
      btRigidBody b(btRigidBody::btRigidBodyConstructionInfo(1, nullptr, &sphere, btVector3(1, 1, 1)));
      world.addRigidBody(&a);
      world.addRigidBody(&b);
      world.performDiscreteCollisionDetection();
      ASSERT_EQ(rig.pair_count(), 1) << kind;
      const btVector3 lo = a.getBroadphaseHandle()->m_aabbMin, hi = a.getBroadphaseHandle()->m_aabbMax;
      if (not_a_number)
        a.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(nan, 0, 0)));
      else
        a.setInterpolationLinearVelocity(btVector3(btScalar(1e9), 0, 0)),
            a.setLinearVelocity(btVector3(btScalar(1e9), 0, 0));
      if (!not_a_number) {
        btTransform far = a.getWorldTransform();
        far.setOrigin(btVector3(btScalar(1e8), 0, 0));
        a.setInterpolationWorldTransform(far);  // the union with where it is going is too long
      }
      world.updateAabbs();
      EXPECT_EQ(a.getActivationState(), DISABLE_SIMULATION) << kind;
      EXPECT_EQ(a.getBroadphaseHandle()->m_aabbMin, lo) << kind;
      EXPECT_EQ(a.getBroadphaseHandle()->m_aabbMax, hi) << kind;
      world.computeOverlappingPairs();
      EXPECT_EQ(rig.pair_count(), 1) << kind;
      world.removeRigidBody(&a);
      world.removeRigidBody(&b);
      EXPECT_EQ(rig.pair_count(), 0) << kind;
    }
}

TEST(BulletContract, D4_ObjectsThatAreNotUpdatedStayVisible) {
  Rig rig;
  btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
  world.setForceUpdateAllAabbs(false);
  btBoxShape box(btVector3(1, 1, 1));
  std::deque<btCollisionObject> objects(20);
  for (int i = 0; i < 20; ++i) {
    btCollisionObject& object = objects[static_cast<std::size_t>(i)];
    object.setCollisionShape(&box);
    object.getWorldTransform().setOrigin(btVector3(btScalar(i), 0, 0));
    world.addCollisionObject(&object);
  }
  world.performDiscreteCollisionDetection();
  const std::vector<UidPair> before = rig.pairs();
  ASSERT_GT(before.size(), 30u);
  for (btCollisionObject& object : objects) object.forceActivationState(ISLAND_SLEEPING);
  for (int step = 0; step < 20; ++step) {
    world.performDiscreteCollisionDetection();
    ASSERT_EQ(rig.pairs(), before);
    ASSERT_EQ(rig.in_box(cube(10, 0, 0, 30)).size(), 20u);
    ASSERT_EQ(rig.on_ray(btVector3(-9, 0, 0), btVector3(40, 0, 0)).size(), 20u);
  }
  for (btCollisionObject& object : objects) world.removeCollisionObject(&object);
}

TEST(BulletContract, N1_PlanesDoNotSpoilTheOthers) {
  auto* oracle = new Oracle(make_broadphase(Kind::subject));
  Rig rig;
  rig.broadphase.reset(oracle);
  const btScalar big = BT_LARGE_FLOAT;
  Random random(1);
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 400; ++i) {
    if (i % 80 == 40) rig.create({btVector3(-big, -big, -big), btVector3(big, big, big)}, 2, ~2);
    if (i % 80 == 41) rig.create({btVector3(-big, -1, -big), btVector3(big, btScalar(-0.5), big)});
    proxies.push_back(rig.create(cube(0, 0, 0)));
  }
  for (int frame = 0; frame < 20; ++frame) {
    for (btBroadphaseProxy* proxy : proxies) {
      const btVector3 p = random.vector(-6, 6);
      rig.move(proxy, cube(p.x(), p.y(), p.z()));
    }
    rig.calculate();
    ASSERT_TRUE(oracle->check(Rule::exact)) << "frame " << frame;
    const Box box = cube(0, 0, 0, 1);
    ASSERT_EQ(rig.in_box(box), sorted(oracle->expected_in_box(box.lo, box.hi)));
    ASSERT_GE(rig.on_ray(btVector3(-90, 5, 0), btVector3(90, 5, 0)).size(), 5u);
  }
}

TEST(BulletContract, N1_RaysMeetPlanes) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    Rig rig(kind);
    const btScalar big = BT_LARGE_FLOAT;
    rig.create({btVector3(-big, -big, -big), btVector3(big, big, big)});
    rig.create(cube(5, 0, 0));
    EXPECT_EQ(rig.on_ray(btVector3(0, 0, 0), btVector3(10, 0, 0)).size(), 2u) << kind;
    EXPECT_EQ(rig.on_ray(btVector3(0, 10, 0), btVector3(0, -10, 1)).size(), 1u) << kind;
    EXPECT_EQ(rig.on_ray(btVector3(0, 10, 0), btVector3(0, -10, 1), btVector3(-9, -1, -1), btVector3(9, 1, 1)).size(),
              2u)
        << kind;
  }
}

TEST(BulletContract, N2_InfiniteBoxesOverlapWhatTheyCover) {
  for (const Kind kind : {Kind::simple, Kind::subject}) {
    auto* oracle = new Oracle(make_broadphase(kind));
    Rig rig;
    rig.broadphase.reset(oracle);
    std::vector<btBroadphaseProxy*> infinite{rig.create({btVector3(-inf, -inf, -inf), btVector3(inf, inf, inf)}),
                                             rig.create({btVector3(-inf, -inf, -inf), btVector3(inf, 0, inf)}),
                                             rig.create({btVector3(3, -inf, -inf), btVector3(inf, inf, inf)}),
                                             rig.create({btVector3(inf, inf, inf), btVector3(inf, inf, inf)})};
    Random random(2);
    std::vector<btBroadphaseProxy*> proxies;
    for (int i = 0; i < 100; ++i) proxies.push_back(rig.create(cube(0, btScalar(i - 50), 0)));
    for (int frame = 0; frame < 10; ++frame) {
      for (btBroadphaseProxy* proxy : proxies) {
        const btVector3 p = random.vector(-6, 6);
        rig.move(proxy, cube(p.x(), p.y(), p.z()));
      }
      if (frame == 5) rig.move(infinite[1], cube(0, 0, 0));
      if (frame == 7) rig.move(infinite[1], {btVector3(-inf, -1, -1), btVector3(inf, 1, 1)});
      rig.calculate();
      ASSERT_TRUE(oracle->check(Rule::exact)) << kind << ", frame " << frame;
    }
    if (kind == Kind::subject) {
      const Box box = cube(4, -1, 0);
      EXPECT_EQ(rig.in_box(box), sorted(oracle->expected_in_box(box.lo, box.hi)));
      const auto hit = rig.on_ray(btVector3(-50, 0, 0), btVector3(50, 0, 0));
      EXPECT_TRUE(std::binary_search(hit.begin(), hit.end(), infinite[0]));
      EXPECT_TRUE(std::binary_search(hit.begin(), hit.end(), infinite[2]));
    }
  }
}

TEST(BulletContract, N3_BadBoxesDisturbNobodyAndCanBeRepaired) {
  const Box bad[] = {{btVector3(nan, nan, nan), btVector3(nan, nan, nan)},
                     {btVector3(-1, nan, -1), btVector3(1, 1, 1)},
                     {btVector3(-1, -1, -1), btVector3(1, 1, nan)},
                     {btVector3(1, 1, 1), btVector3(-1, -1, -1)},
                     {btVector3(-1, 1, -1), btVector3(1, -1, 1)},
                     {btVector3(inf, inf, inf), btVector3(-inf, -inf, -inf)},
                     {btVector3(BT_LARGE_FLOAT, 0, 0), btVector3(-BT_LARGE_FLOAT, 0, 0)}};
  for (const Box& box : bad) {
    auto* oracle = new Oracle(make_broadphase(Kind::subject));
    Rig rig;
    rig.broadphase.reset(oracle);
    GhostLog ghost;
    rig.cache().setInternalGhostPairCallback(&ghost);
    std::vector<btBroadphaseProxy*> proxies;
    for (int i = 0; i < 60; ++i) proxies.push_back(rig.create(cube(btScalar(i) / 3, 0, 0)));
    btBroadphaseProxy* created_bad = rig.create(box);
    rig.calculate();
    ASSERT_TRUE(oracle->check(Rule::exact));
    for (int frame = 0; frame < 6; ++frame) {
      for (std::size_t i = 0; i < 60; ++i)
        rig.move(proxies[i],
                 i % 6 == static_cast<std::size_t>(frame) ? box : cube(btScalar(i) / 3, btScalar(frame) / 10, 0));
      rig.calculate();
      ASSERT_TRUE(oracle->check(Rule::exact)) << "frame " << frame;
      EXPECT_EQ(rig.in_box(cube(10, 0, 0, 30)).size(), 50u);  // found by no query
      EXPECT_LE(rig.on_ray(btVector3(-5, 0, 0), btVector3(50, 0, 0)).size(), 50u);
      for (std::size_t i = 0; i < 60; ++i)
        if (i % 6 == static_cast<std::size_t>(frame)) {
          for (btBroadphaseProxy* other : proxies) ASSERT_FALSE(rig.holds(proxies[i], other));
        }
    }
    rig.move(created_bad, cube(0, 0, 0));
    for (std::size_t i = 0; i < 60; ++i) rig.move(proxies[i], cube(btScalar(i) / 3, 0, 0));
    rig.calculate();
    ASSERT_TRUE(oracle->check(Rule::exact)) << "after repair";
    EXPECT_TRUE(rig.holds(created_bad, proxies[0]));
    rig.move(proxies[7], box);
    rig.destroy(proxies[7]);
    rig.destroy(created_bad);
    rig.calculate();
    ASSERT_TRUE(oracle->check(Rule::exact));
    EXPECT_EQ(ghost.standing(), sorted(rig.pairs()));
    rig.cache().setInternalGhostPairCallback(nullptr);
  }
}

TEST(BulletContract, N4_DegenerateAndIdenticalBoxes) {
  auto* oracle = new Oracle(make_broadphase(Kind::subject));
  Rig rig;
  rig.broadphase.reset(oracle);
  for (int i = 0; i < 60; ++i) {
    rig.create(cube(1, 2, 3, 0));                                              // the same point
    rig.create({btVector3(0, btScalar(i), 0), btVector3(9, btScalar(i), 9)});  // flat
    rig.create({btVector3(0, 0, btScalar(i)), btVector3(0, 9, btScalar(i))});  // a line
    rig.create(cube(btScalar(i % 4), 0, 0));
    rig.create({btVector3(-0.0, -0.0, -0.0), btVector3(0, 0, 0)});
  }
  rig.calculate();
  ASSERT_TRUE(oracle->check(Rule::exact));
  EXPECT_GT(rig.pair_count(), 3000);
}

TEST(BulletContract, N4_ThreeThousandCreatedAtOnePointThenMoved) {
  Rig rig;
  btCollisionWorld world(&rig.dispatcher, rig.broadphase.get(), &rig.config);
  FunctionFilter count([](auto, auto) { return true; });
  rig.cache().setOverlapFilterCallback(&count);
  btBoxShape box(btVector3(btScalar(0.5), btScalar(0.5), btScalar(0.5)));
  std::deque<btCollisionObject> objects(3000);
  for (btCollisionObject& object : objects) {
    object.setCollisionShape(&box);
    world.addCollisionObject(&object);
  }
  EXPECT_EQ(rig.pair_count(), 0);
  for (int i = 0; i < 3000; ++i)
    objects[static_cast<std::size_t>(i)].getWorldTransform().setOrigin(
        btVector3(btScalar(i % 15), btScalar(i / 15 % 15) * 2, btScalar(i / 225) * 2));
  world.performDiscreteCollisionDetection();
  // Rows along x touch (with the world's margin), nothing else: 14 in each full row of 15.
  EXPECT_EQ(rig.pair_count(), 2800);
  EXPECT_EQ(count.calls, 2800) << "4.5 million pairs at the origin never came into being";
  rig.cache().setOverlapFilterCallback(nullptr);
  for (btCollisionObject& object : objects) world.removeCollisionObject(&object);
}

TEST(BulletContract, A1_ProxiesAreAligned) {
  Rig rig;
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(reinterpret_cast<std::uintptr_t>(rig.create(cube(0, btScalar(2 * i), 0))) % 16, 0u) << i;
}

TEST(BulletContract, A1_TheFourthComponentMeansNothing) {
  Rig rig;
  btBroadphaseProxy* a = rig.create(cube(0, 0, 0));
  btBroadphaseProxy* b = rig.create(cube(0, 5, 0));
  for (const btScalar w : {nan, inf, btScalar(0)}) {
    Box box = cube(0, 5, 0);
    box.lo.setW(w);
    box.hi.setW(-w);
    rig.move(a, box);
    rig.calculate();
    EXPECT_TRUE(rig.holds(a, b));
    EXPECT_EQ(rig.in_box(box).size(), 2u);
    box = cube(0, 50, 0);
    box.lo.setW(-w);
    rig.move(a, box);
    rig.calculate();
    EXPECT_FALSE(rig.holds(a, b));
  }
}

TEST(BulletContract, A4_PairsAreExactToTheLastBit) {
  for (const btScalar at : {btScalar(1), btScalar(1e6), btScalar(-3e-3), btScalar(1e-38)}) {
    Rig rig;
    btBroadphaseProxy* left = rig.create({btVector3(at - 1, 0, 0), btVector3(at, 1, 1)});
    btBroadphaseProxy* right = rig.create({btVector3(at, 0, 0), btVector3(at + 1, 1, 1)});
    rig.calculate();
    EXPECT_TRUE(rig.holds(left, right)) << at;
    const btScalar beyond = std::nextafter(at, std::numeric_limits<btScalar>::max());
    rig.move(right, {btVector3(beyond, 0, 0), btVector3(at + 1, 1, 1)});
    EXPECT_EQ(rig.in_box({left->m_aabbMin, left->m_aabbMax}).size(), 1u) << at;
    rig.calculate();
    EXPECT_FALSE(rig.holds(left, right)) << at;
    rig.move(left, {btVector3(at - 1, 0, 0), btVector3(beyond, 1, 1)});
    rig.calculate();
    EXPECT_TRUE(rig.holds(left, right)) << at;
  }
}

TEST(BulletContract, A5_LargestFiniteCoordinates) {
  const btScalar most = std::numeric_limits<btScalar>::max();
  auto* oracle = new Oracle(make_broadphase(Kind::subject));
  Rig rig;
  rig.broadphase.reset(oracle);
  for (int i = 0; i < 20; ++i) {
    rig.create({btVector3(-most, -most, -most), btVector3(most, most, most)});
    rig.create({btVector3(most / 2, 0, 0), btVector3(most, most, most)});
    rig.create({btVector3(-most, -most, -most), btVector3(-most, -most, -most)});
    rig.create(cube(btScalar(i), 0, 0));
  }
  rig.calculate();
  EXPECT_TRUE(oracle->check(Rule::exact));
  EXPECT_EQ(rig.in_box(cube(0, 0, 0, btScalar(0.25))).size(), 21u);
  EXPECT_GE(rig.on_ray(btVector3(0, 0, 0), btVector3(30, 0, 0)).size(), 40u);
}

}  // namespace
}  // namespace boxstream::bullet_test
