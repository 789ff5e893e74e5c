// SPDX-License-Identifier: MIT
#include "minimal.hpp"

/// mixer.json by hand.
int main(int, char** argv) {
  using namespace boxstream::effects_test;
  const int steps = std::atoi(argv[1]);
  btStaticPlaneShape floor(btVector3(0, 1, 0), 0);
  btBoxShape arm(btVector3(4, 0.5f, 0.25f));
  btSphereShape ball(0.5f);
  MinimalWorld minimal;
  minimal.add(floor, 0, at(0, 0, 0), btCollisionObject::CF_STATIC_OBJECT);
  btRigidBody& paddle = minimal.add(arm, 0, at(0, 0.5, 0), btCollisionObject::CF_KINEMATIC_OBJECT);
  for (int y = 0; y < 2; ++y)
    for (int z = 0; z < 8; ++z)
      for (int x = 0; x < 8; ++x) minimal.add(ball, 1, at((x - 3.5) * 1.0625, 1.75 + y * 1.25, (z - 3.5) * 1.0625));
  for (int i = 0; i < steps; ++i) {
    btTransform next;
    btTransformUtil::integrateTransform(paddle.getWorldTransform(), btVector3(0, 0, 0), btVector3(0, 2, 0),
                                        MinimalWorld::step, next);
    paddle.setWorldTransform(next);
    minimal.world.stepSimulation(MinimalWorld::step, 0);
  }
  minimal.print_hash();
  return 0;
}
