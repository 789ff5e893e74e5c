// SPDX-License-Identifier: MIT
// A small Bullet program as users have them: a tower of five boxes comes to rest.
#include <btBulletDynamicsCommon.h>

#include <cstdio>
#include <memory>
#include <vector>

int main() {
  auto configuration = std::make_unique<btDefaultCollisionConfiguration>();
  auto dispatcher = std::make_unique<btCollisionDispatcher>(configuration.get());
  auto solver = std::make_unique<btSequentialImpulseConstraintSolver>();
  btBroadphaseInterface* broadphase = new btDbvtBroadphase;
  auto world =
      std::make_unique<btDiscreteDynamicsWorld>(dispatcher.get(), broadphase, solver.get(), configuration.get());

  btBoxShape floor_shape(btVector3(10, 1, 10));
  btBoxShape box_shape(btVector3(0.5f, 0.5f, 0.5f));
  btVector3 inertia;
  box_shape.calculateLocalInertia(1, inertia);

  std::vector<std::unique_ptr<btRigidBody>> bodies;
  bodies.push_back(std::make_unique<btRigidBody>(0.0f, nullptr, &floor_shape));
  for (int i = 0; i < 5; ++i) {
    bodies.push_back(std::make_unique<btRigidBody>(1.0f, nullptr, &box_shape, inertia));
    bodies.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 2 + 1.5f * i, 0)));
  }
  for (auto& body : bodies) world->addRigidBody(body.get());

  for (int step = 0; step < 300; ++step) world->stepSimulation(1.0f / 60, 0);

  for (auto& body : bodies) std::printf("%.2f\n", body->getWorldTransform().getOrigin().y());
  std::printf("%d contacts\n", dispatcher->getNumManifolds());

  for (auto& body : bodies) world->removeRigidBody(body.get());
  world.reset();
  delete broadphase;
}
