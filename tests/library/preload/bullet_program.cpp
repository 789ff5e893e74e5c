// SPDX-License-Identifier: MIT
// A program that knows nothing of boxstream and uses btDbvtBroadphase in the ways that a replacement must survive: on
// the stack, as a base class, by setAabbForceUpdate, with a given pair cache, for queries alone, ended through the
// interface, from several threads. It prints what is the same for every broad-phase that is right.
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

namespace {

struct Counting : btDbvtBroadphase {
  int moved = 0;
  void setAabb(btBroadphaseProxy* proxy, const btVector3& min, const btVector3& max,
               btDispatcher* dispatcher) override {
    ++moved;
    btDbvtBroadphase::setAabb(proxy, min, max, dispatcher);
  }
};

struct Hits : btBroadphaseRayCallback {
  int count = 0;
  bool process(const btBroadphaseProxy*) override {
    ++count;
    return true;
  }
};

/// Balls of 0.6 m that fall into a trough, and are taken out one by one.
void simulate(const char* what, btBroadphaseInterface& broadphase) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity(btVector3(0, btScalar(-9.81), 0));
  btBoxShape floor_shape(btVector3(12, 1, 12));
  btSphereShape ball_shape(btScalar(0.6));
  btRigidBody floor(0, nullptr, &floor_shape);
  world.addRigidBody(&floor);
  std::vector<btRigidBody*> balls;
  btVector3 inertia;
  ball_shape.calculateLocalInertia(2, inertia);
  for (int i = 0; i < 40; ++i) {
    auto* const ball = new btRigidBody(2, nullptr, &ball_shape, inertia);
    btTransform place;
    place.setIdentity();
    place.setOrigin(
        btVector3(btScalar(i % 4) * btScalar(1.3), btScalar(2 + i / 16), btScalar(i / 4 % 4) * btScalar(1.3)));
    ball->setWorldTransform(place);
    world.addRigidBody(ball);
    balls.push_back(ball);
  }
  for (int step = 0; step < 90; ++step) world.stepSimulation(btScalar(1) / 60, 0);
  int contacts = 0;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    contacts += dispatcher.getManifoldByIndexInternal(i)->getNumContacts() > 0;
  }
  Hits hits;
  const btVector3 from(-20, 0, -20), to(20, 0, 20);
  hits.m_rayDirectionInverse.setValue(1, BT_LARGE_FLOAT, 1);
  hits.m_signs[0] = hits.m_signs[1] = hits.m_signs[2] = 0;
  hits.m_lambda_max = 40;
  broadphase.rayTest(from, to, hits);
  std::printf("%s: %d bodies that touch, ray meets the floor: %d\n", what, contacts > 0, hits.count > 0);
  for (btRigidBody* ball : balls) {
    world.removeRigidBody(ball);
    delete ball;
  }
  world.removeRigidBody(&floor);
  std::printf("%s: %d pairs are left\n", what, broadphase.getOverlappingPairCache()->getNumOverlappingPairs());
}

/// Many boxes that move at random, and rays and boxes that are asked for.
void boxes(btDbvtBroadphase& broadphase) {
  std::mt19937 random(20261);
  const auto place = [&random] {
    std::uniform_real_distribution<float> in(-30, 30);
    return btVector3(in(random), in(random), in(random));
  };
  const btVector3 half(1, btScalar(1.5), 2);
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 400; ++i) {
    const btVector3 at = place();
    proxies.push_back(broadphase.createProxy(at - half, at + half, BOX_SHAPE_PROXYTYPE, nullptr, 1, -1, nullptr));
  }
  for (int step = 0; step < 20; ++step) {
    for (std::size_t i = 0; i < proxies.size(); i += 3) {
      const btVector3 at = place();
      if (i % 2 == 0) {
        broadphase.setAabb(proxies[i], at - half, at + half, nullptr);
      } else {
        broadphase.setAabbForceUpdate(proxies[i], at - half, at + half, nullptr);
      }
    }
    if (step == 10) {
      for (int i = 0; i < 50; ++i) {
        broadphase.destroyProxy(proxies.back(), nullptr);
        proxies.pop_back();
      }
    }
    broadphase.calculateOverlappingPairs(nullptr);
    for (int i = 0; i < 10; ++i) {
      Hits hits;
      const btVector3 from = place();
      btVector3 direction = place() - from;
      hits.m_lambda_max = direction.length();
      direction.normalize();
      for (int axis = 0; axis < 3; ++axis) {
        hits.m_rayDirectionInverse[axis] = direction[axis] == 0 ? btScalar(BT_LARGE_FLOAT) : 1 / direction[axis];
        hits.m_signs[axis] = hits.m_rayDirectionInverse[axis] < 0;
      }
      broadphase.rayTest(from, from + direction, hits);
      broadphase.aabbTest(from - 3 * half, from + 3 * half, hits);
    }
  }
  std::printf("boxes: done\n");
}

/// Four threads ask one world at once, which Bullet's own does not stand.
void rays_on_threads() {
  btDbvtBroadphase broadphase;
  std::mt19937 random(4);
  std::uniform_real_distribution<btScalar> in(0, 30);
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < 1000; ++i) {
    const btVector3 low(in(random), in(random), in(random));
    proxies.push_back(
        broadphase.createProxy(low, low + btVector3(1, 1, 1), BOX_SHAPE_PROXYTYPE, nullptr, 1, -1, nullptr));
  }
  std::vector<long> hits(4);
  std::vector<std::thread> threads;
  for (long& sum : hits)
    threads.emplace_back([&] {
      struct Count : btBroadphaseRayCallback {
        long hits = 0;
        bool process(const btBroadphaseProxy*) override { return ++hits, true; }
      } count;
      const btVector3 from(-1, -1, -1), to(31, 31, 31), along = (to - from).normalized();
      for (int axis = 0; axis < 3; ++axis) count.m_rayDirectionInverse[axis] = 1 / along[axis], count.m_signs[axis] = 0;
      count.m_lambda_max = along.dot(to - from);
      for (int i = 0; i < 300; ++i) broadphase.rayTest(from, to, count);
      sum = count.hits;
    });
  for (auto& thread : threads) thread.join();
  std::printf("on threads: %s\n", hits == std::vector<long>(4, hits[0]) && hits[0] > 300 ? "the same" : "different");
  for (btBroadphaseProxy* const proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
}

}  // namespace

int main(int count, char** arguments) {
  if (count == 2 && std::strcmp(arguments[1], "threads") == 0) return rays_on_threads(), 0;
  {
    btDbvtBroadphase broadphase;
    simulate("on the stack", broadphase);
  }
  {
    Counting broadphase;
    simulate("derived", broadphase);
    std::printf("derived: %d calls\n", broadphase.moved);
  }
  {
    btHashedOverlappingPairCache cache;
    btDbvtBroadphase broadphase(&cache);
    simulate("with a cache", broadphase);
  }
  {
    btNullPairCache cache;
    btDbvtBroadphase broadphase(&cache);
    boxes(broadphase);
  }
  {
    auto* const broadphase = new btDbvtBroadphase;
    broadphase->m_deferedcollide = true;
    broadphase->setVelocityPrediction(1);
    boxes(*broadphase);
    broadphase->optimize();
    btBroadphaseInterface* const interface = broadphase;
    delete interface;
  }
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([] {
      btDbvtBroadphase broadphase;
      boxes(broadphase);
    });
  }
  for (auto& thread : threads) thread.join();
}
