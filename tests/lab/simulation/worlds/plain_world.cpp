// SPDX-License-Identifier: MIT
#include "plain_world.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bullet/oracle.hpp"
#include "formats/record/forwarding_broadphase.hpp"

namespace boxstream::worlds_test {
namespace {

using IndexPair = std::pair<int, int>;

bool is_exact(Kind kind) {
  return kind == Kind::subject || kind == Kind::simple;
}

IndexPair indices_of(const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
  const auto index = [](const btBroadphaseProxy* proxy) {
    return static_cast<const btCollisionObject*>(proxy->m_clientObject)->getUserIndex();
  };
  return std::minmax(index(a), index(b));
}

bool boxes_overlap(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  return bullet_test::is_valid_box(a.m_aabbMin, a.m_aabbMax) && bullet_test::is_valid_box(b.m_aabbMin, b.m_aabbMax) &&
         bullet_test::boxes_overlap(a.m_aabbMin, a.m_aabbMax, b.m_aabbMin, b.m_aabbMax);
}

std::vector<IndexPair> held_by(const btOverlappingPairCache& cache, bool only_overlapping) {
  std::vector<IndexPair> pairs;
  const int count = cache.getNumOverlappingPairs();
  const btBroadphasePair* const held = count > 0 ? cache.getOverlappingPairArrayPtr() : nullptr;
  for (int i = 0; i < count; ++i)
    if (!only_overlapping || boxes_overlap(*held[i].m_pProxy0, *held[i].m_pProxy1))
      pairs.push_back(indices_of(held[i].m_pProxy0, held[i].m_pProxy1));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

/// All pairs that there must be: nothing but a sort along one axis.
std::vector<IndexPair> search(const PlainWorld& world) {
  std::vector<const btBroadphaseProxy*> order;
  for (const auto& body : world.bodies) {
    const btBroadphaseProxy* const proxy = body->getBroadphaseProxy();
    if (bullet_test::is_valid_box(proxy->m_aabbMin, proxy->m_aabbMax)) order.push_back(proxy);
  }
  std::sort(order.begin(), order.end(),
            [](const btBroadphaseProxy* a, const btBroadphaseProxy* b) { return a->m_aabbMin.x() < b->m_aabbMin.x(); });
  std::vector<IndexPair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size() && order[k]->m_aabbMin.x() <= order[i]->m_aabbMax.x(); ++k)
      if (boxes_overlap(*order[i], *order[k]) &&
          (order[i]->m_collisionFilterGroup & order[k]->m_collisionFilterMask) != 0 &&
          (order[k]->m_collisionFilterGroup & order[i]->m_collisionFilterMask) != 0)
        pairs.push_back(indices_of(order[i], order[k]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::subject:
      return "boxstream";
    case Kind::dbvt_deferred:
      return "dbvt-deferred";
    case Kind::axis16:
      return "sap-16";
    case Kind::axis32:
      return "sap";
    case Kind::simple:
      return "simple";
    case Kind::dbvt:
      break;
  }
  return "dbvt";
}

const char* precision() {
  return is_double ? "double" : "float";
}

PlainWorld::PlainWorld(Kind kind, const Room& room)
    : PlainWorld(bullet_test::make_broadphase(kind, nullptr, room), is_exact(kind)) {}

PlainWorld::PlainWorld(std::unique_ptr<btBroadphaseInterface> made, bool exact)
    : broadphase(std::move(made)),
      world(std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, broadphase.get(), &solver, &config)),
      exact_(exact) {
  world->setGravity(btVector3(0, -10, 0));
}

PlainWorld::~PlainWorld() {
  clear();
  world.reset();
}

void PlainWorld::clear() {
  for (auto& joint : joints) world->removeConstraint(joint.get());
  joints.clear();
  while (!bodies.empty()) remove(bodies.size() - 1);
  shapes_.clear();
  EXPECT_EQ(broadphase->getOverlappingPairCache()->getNumOverlappingPairs(), 0);
  EXPECT_EQ(dispatcher.freed, dispatcher.allocated);
}

void PlainWorld::end_all_pairs() {
  boxstream::scenes::EndAllPairs end_all;
  broadphase->getOverlappingPairCache()->processAllOverlappingPairs(&end_all, &dispatcher);
}

btRigidBody& PlainWorld::add(btScalar mass, btCollisionShape* shape, const btVector3& at, const btQuaternion& turned) {
  btVector3 inertia(0, 0, 0);
  if (mass > 0) shape->calculateLocalInertia(mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, shape, inertia);
  info.m_startWorldTransform = btTransform(turned, at);
  bodies.push_back(std::make_unique<btRigidBody>(info));
  bodies.back()->setUserIndex(static_cast<int>(bodies.size()) - 1);
  world->addRigidBody(bodies.back().get());
  return *bodies.back();
}

btRigidBody& PlainWorld::add_ground(const btVector3& at) {
  return add(0, shape<btBoxShape>(btVector3(10, 1, 10)), at - btVector3(0, 1, 0));
}

void PlainWorld::remove(std::size_t body) {
  world->removeRigidBody(bodies[body].get());
  std::swap(bodies[body], bodies.back());
  bodies[body]->setUserIndex(static_cast<int>(body));
  bodies.pop_back();
}

void PlainWorld::add(std::unique_ptr<btTypedConstraint> joint, bool collide) {
  world->addConstraint(joint.get(), !collide);
  joints.push_back(std::move(joint));
}

testing::AssertionResult PlainWorld::check_pairs() const {
  const std::vector<IndexPair> expected = search(*this);
  const std::vector<IndexPair> held = held_by(*broadphase->getOverlappingPairCache(), !exact_);
  if (held == expected) return testing::AssertionSuccess();
  const auto [e, h] = std::mismatch(expected.begin(), expected.end(), held.begin(), held.end());
  const bool missing = h == held.end() || (e != expected.end() && *e < *h);
  const IndexPair first = missing ? *e : *h;
  return testing::AssertionFailure() << held.size() << " pairs, " << expected.size() << " expected; first "
                                     << (missing ? "missing: " : "extra: ") << first.first << " and " << first.second;
}

std::size_t PlainWorld::missed_pairs() const {
  const std::vector<IndexPair> expected = search(*this);
  const std::vector<IndexPair> held = held_by(*broadphase->getOverlappingPairCache(), false);
  std::vector<IndexPair> missed;
  std::set_difference(expected.begin(), expected.end(), held.begin(), held.end(), std::back_inserter(missed));
  return missed.size();
}

std::vector<IndexPair> PlainWorld::held_pairs() const {
  return held_by(*broadphase->getOverlappingPairCache(), true);
}

bool PlainWorld::is_finite() const {
  return std::all_of(bodies.begin(), bodies.end(), [](const auto& body) {
    const btTransform& at = body->getWorldTransform();
    btScalar sum = 0;
    for (int d = 0; d < 3; ++d)
      for (const btScalar x : {at.getOrigin()[d], at.getBasis()[d].x(), at.getBasis()[d].y(), at.getBasis()[d].z(),
                               body->getLinearVelocity()[d], body->getAngularVelocity()[d]})
        sum += x * 0;
    return sum == 0;
  });
}

bool PlainWorld::all_asleep() const {
  return std::none_of(bodies.begin(), bodies.end(),
                      [](const auto& body) { return !body->isStaticObject() && body->isActive(); });
}

std::uint64_t PlainWorld::state_hash(std::size_t count) const {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto mix = [&hash](const btVector3& v) {
    for (int d = 0; d < 3; ++d) {
      unsigned char bytes[sizeof(btScalar)];
      std::memcpy(bytes, &v.m_floats[d], sizeof bytes);
      for (const unsigned char byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
    }
  };
  for (std::size_t i = 0; i < count; ++i) {
    const btRigidBody& body = *bodies[i];
    mix(body.getWorldTransform().getOrigin());
    for (int row = 0; row < 3; ++row) mix(body.getWorldTransform().getBasis()[row]);
    mix(body.getLinearVelocity());
    mix(body.getAngularVelocity());
  }
  return hash;
}

}  // namespace boxstream::worlds_test
