// SPDX-License-Identifier: MIT
#include "formats/geometry/solid.hpp"
#include "minimal.hpp"

/// chain.json by hand.
int main(int, char** argv) {
  using namespace boxstream::effects_test;
  const int steps = std::atoi(argv[1]);
  constexpr int links = 40;
  constexpr double pitch = 0.75;
  btCapsuleShape link(0.125f, 0.5f);
  const boxstream::geometry::Solid solid = boxstream::geometry::capsule(0.125, 0.5);
  btSphereShape ball(0.5f);
  MinimalWorld minimal;
  const double w = std::sqrt(0.5);
  const btQuaternion along_x(0, 0, static_cast<btScalar>(-1 / (2 * w)), static_cast<btScalar>(w));
  for (int i = 0; i <= links; ++i) {
    btTransform place = at(i == links ? i * pitch + 0.625 : (i + 0.5) * pitch, 20, 0);
    place.setRotation(along_x);
    btRigidBody& body = i == links ? minimal.add(ball, 5, place) : minimal.add(link, 1, place);
    // Bullet's moments are those of the capsule's box.
    if (i < links) {
      const auto moment = [&](std::size_t axis) {
        return static_cast<btScalar>(solid.inertia[axis][axis] * (1 / solid.volume));
      };
      body.setMassProps(1, btVector3(moment(0), moment(1), moment(2)));
      body.updateInertiaTensor();
    }
    const btVector3 pivot = at(i * pitch, 20, 0).getOrigin();
    const btVector3 here = body.getWorldTransform().invXform(pivot);
    if (i == 0) {
      minimal.constraints.push_back(std::make_unique<btPoint2PointConstraint>(body, here));
    } else {
      btRigidBody& former = *minimal.bodies[static_cast<std::size_t>(i) - 1];
      minimal.constraints.push_back(
          std::make_unique<btPoint2PointConstraint>(body, former, here, former.getWorldTransform().invXform(pivot)));
    }
  }
  for (auto& constraint : minimal.constraints) minimal.world.addConstraint(constraint.get(), true);
  for (int i = 0; i < steps; ++i) minimal.world.stepSimulation(MinimalWorld::step, 0);
  minimal.print_hash();
  return 0;
}
