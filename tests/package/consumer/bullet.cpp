// SPDX-License-Identifier: MIT
// Built once for each precision; the argument says which one it ought to be.
#include <btBulletDynamicsCommon.h>

#include <boxstream/bullet.hpp>

#include <cstdio>
#include <cstring>

int main(int argc, char** argv) {
  const char* precision = sizeof(btScalar) == sizeof(double) ? "double" : "float";
  if (argc != 2 || std::strcmp(argv[1], precision) != 0) {
    std::printf("btScalar is %s\n", precision);
    return 1;
  }

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  boxstream::bullet::Broadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);

  btStaticPlaneShape plane(btVector3(0, 1, 0), 0);
  btSphereShape sphere(1);
  btRigidBody ground(0, nullptr, &plane);
  btRigidBody ball(1, nullptr, &sphere, btVector3(1, 1, 1));
  ball.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(0, 3, 0)));
  world.addRigidBody(&ground);
  world.addRigidBody(&ball);
  for (int step = 0; step < 240; ++step) world.stepSimulation(btScalar(1) / 60, 0);

  const btScalar height = ball.getWorldTransform().getOrigin().y();
  const int pairs = broadphase.getOverlappingPairCache()->getNumOverlappingPairs();
  const bool at_rest = height > btScalar(0.9) && height < btScalar(1.1);
  if (!at_rest || pairs != 1) std::printf("height %f, %d pairs\n", double(height), pairs);

  world.removeRigidBody(&ball);
  world.removeRigidBody(&ground);
  return at_rest && pairs == 1 ? 0 : 1;
}
