// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <BulletSoftBody/btSoftBody.h>
#include <btBulletDynamicsCommon.h>

#include "scene/expand.hpp"
#include "simulation/bullet_shapes.hpp"
#include "simulation/bullet_world.hpp"
#include "simulation/walker.hpp"

namespace boxstream::scenes {

/// A kinematic body goes on with the velocities that it starts with.
struct Moved {
  btRigidBody* body;
  btVector3 velocity;
  btVector3 spin;
};

/// Everything that a scene puts into its world; takes it out again at the end, in Bullet's order.
/// `objects[i]->getUserIndex() == i`: bodies, then sensors, characters and soft bodies.
class WorldObjects {
 public:
  WorldObjects(const Scene& scene, Expanded expanded, BulletWorld& world);
  ~WorldObjects();
  WorldObjects(const WorldObjects&) = delete;
  WorldObjects& operator=(const WorldObjects&) = delete;

  const BuiltShape& built(std::size_t body) const { return *built_[body]; }

  ShapeSet shapes;
  std::vector<std::size_t> shape_of;  // of each body: index into `shapes`
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
  std::vector<std::unique_ptr<btCollisionShape>> sensor_shapes;
  std::vector<std::unique_ptr<btGhostObject>> sensors;
  std::vector<Walker> walkers;
  std::vector<std::unique_ptr<btSoftBody>> soft_bodies;

  std::vector<btCollisionObject*> objects;
  std::vector<Moved> moved;

 private:
  void add_body(const Body& description);
  void add_joint(const Joint& description);
  void add_sensor(const Sensor& description);
  void add_soft_body(const SoftBody& description);
  void number(btCollisionObject& object);

  BulletWorld& world_;
  double dt_;
  std::vector<const BuiltShape*> built_;  // of each body
};

}  // namespace boxstream::scenes
