// SPDX-License-Identifier: MIT
// What users ask a world between steps, on the same static scene with every broad-phase (clause D7), and ghost lists of
// worlds that move by script, so that they cannot diverge (D6).
#include <cmath>
#include <set>

#include "test_world.hpp"

namespace boxstream::bullet_test {
namespace {

void scatter(TestWorld& t, int n) {
  Random random(70);
  btCollisionShape* kinds[] = {
      t.shape<btBoxShape>(btVector3(1, btScalar(0.5), btScalar(0.7))), t.shape<btSphereShape>(btScalar(0.8)),
      t.shape<btCapsuleShape>(btScalar(0.4), btScalar(1.5)), t.shape<btConeShape>(btScalar(0.6), btScalar(1.2))};
  for (int i = 0; i < n; ++i) {
    const btVector3 at = random.vector(-12, 12);
    const btVector3 axis = random.vector(1, 2).normalized();
    t.object(kinds[i % 4], btTransform(btQuaternion(axis, random.real(0, 6)), at));
  }
  t.body(0, t.shape<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(-14)), btVector3(0, 0, 0));
}

struct Contacts : btCollisionWorld::ContactResultCallback {
  explicit Contacts(const btCollisionObject* asker) : asker_(asker) {}
  btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper* a, int, int,
                           const btCollisionObjectWrapper* b, int, int) override {
    others.insert((a->m_collisionObject == asker_ ? b : a)->m_collisionObject->getUserIndex());
    return 0;
  }
  std::set<int> others;

 private:
  const btCollisionObject* asker_;
};

struct Answers {
  std::vector<btScalar> rays, sweeps;
  std::vector<std::size_t> all_hits;
  std::vector<std::set<int>> contacts;
};

Answers ask(TestWorld& t) {
  Answers answers;
  Random random(71);
  for (int i = 0; i < t.world->getNumCollisionObjects(); ++i) t.world->getCollisionObjectArray()[i]->setUserIndex(i);
  btSphereShape sphere(btScalar(0.4));
  btBoxShape box(btVector3(btScalar(0.6), btScalar(0.2), btScalar(0.3)));
  for (int i = 0; i < 300; ++i) {
    const btVector3 from = random.vector(-15, 15);
    btVector3 to = random.vector(-15, 15);
    if (i % 5 == 0) to[i % 3] = from[i % 3];
    btCollisionWorld::ClosestRayResultCallback ray(from, to);
    t.world->rayTest(from, to, ray);
    answers.rays.push_back(ray.m_closestHitFraction);
    btCollisionWorld::AllHitsRayResultCallback all(from, to);
    t.world->rayTest(from, to, all);
    answers.all_hits.push_back(static_cast<std::size_t>(all.m_collisionObjects.size()));
    const btConvexShape* cast = i % 2 ? static_cast<const btConvexShape*>(&sphere) : &box;
    const btTransform a(btQuaternion(btVector3(0, 1, 0), btScalar(i)), from);
    const btTransform b(btQuaternion(btVector3(0, 1, 0), btScalar(i) + (i % 3 ? 0 : 1)), to);
    btCollisionWorld::ClosestConvexResultCallback sweep(from, to);
    t.world->convexSweepTest(cast, a, b, sweep);
    answers.sweeps.push_back(sweep.m_closestHitFraction);
    if (i % 10 == 0) {
      btCollisionObject asker;
      btBoxShape shape(btVector3(1, 1, 1));
      asker.setCollisionShape(&shape);
      asker.setWorldTransform(a);
      Contacts contacts(&asker);
      t.world->contactTest(&asker, contacts);
      answers.contacts.push_back(contacts.others);
    }
  }
  return answers;
}

TEST(BulletWorldQueries, D7_ClosestHitsEqualOnEveryBroadphase) {
  for (const bool calculated : {false, true}) {
    Answers first;
    for (const Kind kind : all_kinds) {
      TestWorld t(kind);
      scatter(t, 300);
      if (calculated) t.world->performDiscreteCollisionDetection();
      Answers answers = ask(t);
      if (kind == Kind::subject) {
        first = answers;
        EXPECT_GT(std::count_if(first.rays.begin(), first.rays.end(), [](btScalar f) { return f < 1; }), 100);
        EXPECT_GT(std::count_if(first.sweeps.begin(), first.sweeps.end(), [](btScalar f) { return f < 1; }), 100);
        continue;
      }
      EXPECT_EQ(first.rays, answers.rays) << kind;
      EXPECT_EQ(first.sweeps, answers.sweeps) << kind;
      EXPECT_EQ(first.all_hits, answers.all_hits) << kind;
      EXPECT_EQ(first.contacts, answers.contacts) << kind;
    }
  }
}

TEST(BulletWorldQueries, Q1_MovedObjectsAreFoundAfterUpdateSingleAabb) {
  Answers answers[2];
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    TestWorld t(kind);
    scatter(t, 200);
    t.world->performDiscreteCollisionDetection();
    Random random(72);
    for (int i = 0; i < 200; i += 2) {
      btCollisionObject* object = t.world->getCollisionObjectArray()[i];
      btTransform at = object->getWorldTransform();
      at.setOrigin(random.vector(-12, 12));
      object->setWorldTransform(at);
      t.world->updateSingleAabb(object);
    }
    answers[kind == Kind::subject] = ask(t);
  }
  EXPECT_EQ(answers[0].rays, answers[1].rays);
  EXPECT_EQ(answers[0].sweeps, answers[1].sweeps);
  EXPECT_EQ(answers[0].contacts, answers[1].contacts);
}

TEST(BulletWorldQueries, Q8_QueriesOfZeroLength) {
  std::vector<btScalar> sweeps[2];
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    TestWorld t(kind);
    scatter(t, 200);
    Random random(75);
    btSphereShape sphere(btScalar(0.4));
    for (int i = 0; i < 200; ++i) {
      const btVector3 at = random.vector(-12, 12);
      const btTransform there(btQuaternion::getIdentity(), at);
      btCollisionWorld::ClosestConvexResultCallback sweep(at, at);
      t.world->convexSweepTest(&sphere, there, there, sweep);
      sweeps[kind == Kind::subject].push_back(sweep.m_closestHitFraction);
      btCollisionWorld::ClosestRayResultCallback ray(at, at);
      t.world->rayTest(at, at, ray);  // NaN in every field, as Bullet is built in Debian; it only has to come back
    }
  }
  EXPECT_EQ(sweeps[0], sweeps[1]);
}

TEST(BulletWorldQueries, Q6_GhostSweepsSeeWhatTheWorldSees) {
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    TestWorld t(kind);
    scatter(t, 200);
    btPairCachingGhostObject* ghost = t.ghost(t.shape<btBoxShape>(btVector3(20, 20, 20)), btVector3(0, 0, 0));
    t.world->performDiscreteCollisionDetection();
    btSphereShape sphere(btScalar(0.3));
    Random random(73);
    for (int i = 0; i < 50; ++i) {
      const btVector3 from = random.vector(-12, 12), to = random.vector(-12, 12);
      btCollisionWorld::ClosestConvexResultCallback by_world(from, to), by_ghost(from, to);
      // the world would report the ghost's own box as well
      by_world.m_collisionFilterMask = by_ghost.m_collisionFilterMask = ~btBroadphaseProxy::SensorTrigger;
      const btTransform a(btQuaternion::getIdentity(), from), b(btQuaternion::getIdentity(), to);
      t.world->convexSweepTest(&sphere, a, b, by_world);
      ghost->convexSweepTest(&sphere, a, b, by_ghost);
      ASSERT_EQ(by_world.m_closestHitFraction, by_ghost.m_closestHitFraction) << kind << ", sweep " << i;
    }
  }
}

TEST(BulletWorldQueries, D6_GhostListsEqualThoseOfDbvtAfterARetest) {
  std::vector<std::vector<int>> lists[2];
  for (const Kind kind : {Kind::dbvt, Kind::subject}) {
    TestWorld t(kind);
    auto* box = t.shape<btBoxShape>(btVector3(1, 1, 1));
    std::vector<btCollisionObject*> movers;
    for (int i = 0; i < 100; ++i) {
      movers.push_back(t.object(box, btTransform::getIdentity()));
      movers.back()->setUserIndex(i);
    }
    for (int i = 0; i < 5; ++i) t.ghost(t.shape<btSphereShape>(btScalar(i)), btVector3(0, 0, 0))->setUserIndex(100 + i);
    Random random(74);
    for (int frame = 0; frame < 80; ++frame) {
      for (std::size_t i = 0; i < movers.size(); ++i) {
        btTransform at = btTransform::getIdentity();
        const btScalar phase = btScalar(frame) / 20 + btScalar(i);
        at.setOrigin(btVector3(8 * std::cos(phase), btScalar(i % 7) - 3, 8 * std::sin(phase * btScalar(0.7))));
        movers[i]->setWorldTransform(at);
      }
      for (btPairCachingGhostObject* ghost : t.ghosts)
        ghost->setWorldTransform(btTransform(btQuaternion::getIdentity(), random.vector(-6, 6)));
      t.world->performDiscreteCollisionDetection();
      for (btPairCachingGhostObject* ghost : t.ghosts) {
        std::vector<int> list;
        for (int i = 0; i < ghost->getNumOverlappingObjects(); ++i) {
          const btCollisionObject* other = ghost->getOverlappingObject(i);
          if (t.oracle->overlap_now(ghost->getBroadphaseHandle(), other->getBroadphaseHandle()))
            list.push_back(other->getUserIndex());
          else
            EXPECT_EQ(kind, Kind::dbvt);
        }
        lists[kind == Kind::subject].push_back(sorted(list));
      }
    }
  }
  EXPECT_EQ(lists[0], lists[1]);
}

}  // namespace
}  // namespace boxstream::bullet_test
