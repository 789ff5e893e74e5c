// SPDX-License-Identifier: MIT
// A Bullet world on boxstream: the broad-phase is the only line that differs from any other Bullet program.
#include <btBulletDynamicsCommon.h>
#include <boxstream/bullet.hpp>

#include <cstdio>
#include <memory>
#include <vector>

int main() {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btSequentialImpulseConstraintSolver solver;
  boxstream::bullet::Broadphase broadphase;  // in place of btDbvtBroadphase
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);

  btBoxShape ground(btVector3(10, 1, 10));
  btBoxShape crate(btVector3(0.5F, 0.5F, 0.5F));
  btVector3 inertia;
  crate.calculateLocalInertia(1, inertia);
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  bodies.push_back(std::make_unique<btRigidBody>(0.0F, nullptr, &ground));
  for (int i = 0; i < 5; ++i) {
    bodies.push_back(std::make_unique<btRigidBody>(1.0F, nullptr, &crate, inertia));
    bodies.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 2 + 1.5F * float(i), 0)));
  }
  for (const auto& body : bodies) world.addRigidBody(body.get());

  for (int step = 0; step < 300; ++step) world.stepSimulation(1.0F / 60, 0);

  for (std::size_t i = 1; i < bodies.size(); ++i)
    std::printf("crate %zu rests at %.1f\n", i, bodies[i]->getWorldTransform().getOrigin().y());
  std::printf("%d pairs\n", broadphase.getOverlappingPairCache()->getNumOverlappingPairs());
  for (const auto& body : bodies) world.removeRigidBody(body.get());
}
