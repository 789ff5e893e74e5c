// SPDX-License-Identifier: MIT
#include "test_world.hpp"

#include <algorithm>
#include <cstring>

namespace boxstream::bullet_test {
namespace {

/// What btGhostPairCallback does, with a log beside it.
class LoggingGhostCallback : public btGhostPairCallback {
 public:
  explicit LoggingGhostCallback(GhostLog& log) : log_(log) {}
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override {
    log_.addOverlappingPair(a, b);
    return btGhostPairCallback::addOverlappingPair(a, b);
  }
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher* dispatcher) override {
    log_.removeOverlappingPair(a, b, dispatcher);
    return btGhostPairCallback::removeOverlappingPair(a, b, dispatcher);
  }

 private:
  GhostLog& log_;
};

}  // namespace

TestWorld::TestWorld(Kind k, btOverlappingPairCache* cache)
    : kind(k),
      oracle(new Oracle(make_broadphase(k, cache))),
      broadphase(oracle),
      world(std::make_unique<btSoftRigidDynamicsWorld>(&dispatcher, broadphase.get(), &solver, &config)),
      forward_(std::make_unique<LoggingGhostCallback>(ghost_log)) {
  broadphase->getOverlappingPairCache()->setInternalGhostPairCallback(forward_.get());
  world->setGravity(btVector3(0, -10, 0));
  oracle->after_calculate = [this] { check_now(); };
}

TestWorld::~TestWorld() {
  clear();
  world.reset();
}

void TestWorld::check_now() {
  if (testing::Test::HasFailure()) return;  // the first step that fails tells it all
  pairs_seen += static_cast<long>(oracle->expected().size());
  EXPECT_TRUE(oracle->check(rule_of(kind))) << kind;
  for (btPairCachingGhostObject* ghost : ghosts) {
    const btBroadphaseProxy* me = ghost->getBroadphaseHandle();
    std::vector<const void*> wanted, listed, cached;
    for (const btBroadphaseProxy* partner : oracle->expected_partners(me)) wanted.push_back(partner->m_clientObject);
    const bool retest = rule_of(kind) == Rule::superset;
    for (int i = 0; i < ghost->getNumOverlappingObjects(); ++i) {
      const btCollisionObject* other = ghost->getOverlappingObject(i);
      if (!retest || oracle->overlap_now(me, other->getBroadphaseHandle())) listed.push_back(other);
    }
    const btBroadphasePairArray& own = ghost->getOverlappingPairCache()->getOverlappingPairArray();
    for (int i = 0; i < own.size(); ++i) {
      const btBroadphaseProxy* other = own[i].m_pProxy0 == me ? own[i].m_pProxy1 : own[i].m_pProxy0;
      if (!retest || oracle->overlap_now(me, other)) cached.push_back(other->m_clientObject);
    }
    EXPECT_EQ(sorted(listed), sorted(wanted)) << kind << ": a ghost's list, calculation " << oracle->calculations();
    EXPECT_EQ(sorted(cached), sorted(wanted)) << kind << ": a ghost's cache, calculation " << oracle->calculations();
  }
}

void TestWorld::run(int steps) {
  for (int step = 0; step < steps && !testing::Test::HasFailure(); ++step) {
    world->stepSimulation(btScalar(1) / 60, 0);
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
      contacts_seen += dispatcher.getManifoldByIndexInternal(i)->getNumContacts();
  }
  for (const btRigidBody* b : bodies) {
    const btVector3& at = b->getWorldTransform().getOrigin();
    ASSERT_TRUE(std::isfinite(at.x()) && std::isfinite(at.y()) && std::isfinite(at.z()));
  }
}

void TestWorld::clear() {
  for (auto& constraint : constraints_) world->removeConstraint(constraint.get());
  constraints_.clear();
  for (auto& character : characters_) world->removeAction(character.get());
  characters_.clear();
  bodies.clear();
  ghosts.clear();
  btCollisionObjectArray& objects = world->getCollisionObjectArray();
  while (objects.size() > 0) {
    btCollisionObject* last = objects[objects.size() / 2];  // from the middle, so that neither order is special
    if (btRigidBody* rigid = btRigidBody::upcast(last)) {
      world->removeRigidBody(rigid);
      delete rigid->getMotionState();
    } else if (btSoftBody* softbody = btSoftBody::upcast(last)) {
      world->removeSoftBody(softbody);
    } else {
      world->removeCollisionObject(last);
    }
    delete last;
  }
  shapes_.clear();
  EXPECT_EQ(broadphase->getOverlappingPairCache()->getNumOverlappingPairs(), 0) << kind;
  EXPECT_TRUE(ghost_log.standing().empty()) << kind;
  EXPECT_EQ(ghost_log.adds(), ghost_log.removes()) << kind;
  EXPECT_EQ(dispatcher.freed, dispatcher.allocated) << kind;
  world->stepSimulation(btScalar(1) / 60, 0);  // lets go of the manifolds of predictive contacts
  EXPECT_EQ(dispatcher.getNumManifolds(), 0) << kind;
  ghost_log.events.clear();
}

btRigidBody* TestWorld::body(btScalar mass, btCollisionShape* shape, const btVector3& at, const btQuaternion& turned) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape->calculateLocalInertia(mass, inertia);
  auto* motion = new btDefaultMotionState(btTransform(turned, at));
  auto* made = new btRigidBody(btRigidBody::btRigidBodyConstructionInfo(mass, motion, shape, inertia));
  world->addRigidBody(made);
  bodies.push_back(made);
  return made;
}

btCollisionObject* TestWorld::object(btCollisionShape* shape, const btTransform& at) {
  auto* made = new btCollisionObject;
  made->setCollisionShape(shape);
  made->setWorldTransform(at);
  world->addCollisionObject(made);
  return made;
}

btPairCachingGhostObject* TestWorld::ghost(btCollisionShape* shape, const btVector3& at) {
  auto* made = new btPairCachingGhostObject;
  made->setCollisionShape(shape);
  made->setCollisionFlags(made->getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  made->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
  world->addCollisionObject(made, btBroadphaseProxy::SensorTrigger, btBroadphaseProxy::AllFilter);
  ghosts.push_back(made);
  return made;
}

btKinematicCharacterController* TestWorld::character(const btVector3& at) {
  auto* capsule = shape<btCapsuleShape>(btScalar(0.4), btScalar(1));
  auto* made = new btPairCachingGhostObject;
  made->setCollisionShape(capsule);
  made->setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
  made->setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
  world->addCollisionObject(made, btBroadphaseProxy::CharacterFilter,
                            btBroadphaseProxy::StaticFilter | btBroadphaseProxy::DefaultFilter);
  ghosts.push_back(made);
  characters_.push_back(
      std::make_unique<btKinematicCharacterController>(made, capsule, btScalar(0.35), btVector3(0, 1, 0)));
  world->addAction(characters_.back().get());
  return characters_.back().get();
}

btSoftBody* TestWorld::soft(btSoftBody* made) {
  world->addSoftBody(made);
  return made;
}

void TestWorld::hinge(btRigidBody* a, btRigidBody* b, const btVector3& pivot_in_a, const btVector3& pivot_in_b) {
  constraints_.push_back(
      std::make_unique<btHingeConstraint>(*a, *b, pivot_in_a, pivot_in_b, btVector3(0, 0, 1), btVector3(0, 0, 1)));
  world->addConstraint(constraints_.back().get(), true);
}

void TestWorld::ground() {
  body(0, shape<btBoxShape>(btVector3(30, 1, 30)), btVector3(0, -1, 0));
}

std::uint64_t TestWorld::state_hash() const {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto mix = [&hash](btScalar value) {
    unsigned char bytes[sizeof(btScalar)];
    std::memcpy(bytes, &value, sizeof value);
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
  };
  for (const btRigidBody* b : bodies) {
    for (int d = 0; d < 3; ++d) {
      mix(b->getWorldTransform().getOrigin()[d]);
      mix(b->getLinearVelocity()[d]);
      mix(b->getAngularVelocity()[d]);
      for (int c = 0; c < 3; ++c) mix(b->getWorldTransform().getBasis()[d][c]);
    }
  }
  for (const btPairCachingGhostObject* g : ghosts)
    for (int d = 0; d < 3; ++d) mix(g->getWorldTransform().getOrigin()[d]);
  return hash;
}

}  // namespace boxstream::bullet_test
