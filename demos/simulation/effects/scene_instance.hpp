// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include <BulletCollision/CollisionShapes/btTriangleInfoMap.h>
#include <BulletDynamics/Vehicle/btRaycastVehicle.h>
#include <BulletSoftBody/btSoftBody.h>
#include <btBulletDynamicsCommon.h>

#include "measure/stopwatch.hpp"
#include "simulation/effects/plan.hpp"
#include "simulation/effects/walker.hpp"
#include "simulation/engine/bullet_shapes.hpp"
#include "simulation/engine/bullet_world.hpp"
#include "simulation/engine/multibodies.hpp"

namespace boxstream::effects {

/// What an effect has called while a world runs.
struct Hook {
  const Effect* effect;
  std::function<void(double dt)> run;
  std::uint64_t calls = 0;
};

/// A ray-cast vehicle and what it needs.
struct Car {
  std::unique_ptr<btVehicleRaycaster> raycaster;
  std::unique_ptr<btRaycastVehicle> vehicle;
};

/// What the queries of the last step found.
struct QueryResults {
  std::uint64_t ray_hits = 0, boxes = 0, contacts = 0;
  std::chrono::nanoseconds time{};
};

/// Everything that a scene puts into its world; takes it out again at the end, in Bullet's order. Rigid bodies are
/// there from the start, all else comes with the effects of the plan.
///
/// `objects[i]->getUserIndex() == i`: bodies, then what effects add. An object that is not in the world now has no
/// broad-phase handle.
struct SceneInstance {
  SceneInstance(const scenes::Scene& scene, scenes::Expanded expanded, scenes::BulletWorld& world);
  ~SceneInstance();
  SceneInstance(const SceneInstance&) = delete;
  SceneInstance& operator=(const SceneInstance&) = delete;

  /// Puts everything in. Not done by the constructor, so that what is in the world is taken out even if this throws.
  void build(const Plan& plan);

  /// Gives an object the next number.
  void number(btCollisionObject& object);
  /// Puts a rigid body into the world, or takes it out, with its joints.
  void enter(std::size_t body);
  void leave(std::size_t body);
  /// To be called before an effect changes a body's velocities, place or presence by itself, and not by forces.
  void acting_on(const btRigidBody& body) const {
    if (world.hooks.acting_on) world.hooks.acting_on(body);
  }

  void run(std::vector<Hook>& hooks, double dt);
  /// By the plan, or switched on since.
  bool is_on(const Decision& decision) const;
  /// Adds what the effects of the plan did in the step that is over to `activity`.
  void observe_activity(const Plan& plan);

  /// A hook gets the length of the step or substep, in seconds.
  void before_step(const Effect& effect, std::function<void(double)> hook);
  void before_substep(const Effect& effect, std::function<void(double)> hook);
  /// Within a substep, when forces are in and contacts are found.
  void before_solver(const Effect& effect, std::function<void(double)> hook);
  /// Within a substep, when the solver is done and bodies have not moved yet.
  void before_motion(const Effect& effect, std::function<void(double)> hook);
  /// Within a substep, when bodies have moved.
  void after_motion(const Effect& effect, std::function<void(double)> hook);
  void after_substep(const Effect& effect, std::function<void(double)> hook);
  void after_step(const Effect& effect, std::function<void(double)> hook);

  const scenes::BuiltShape& built(std::size_t body) const { return *built_[body]; }

  /// Where Bullet has a body, in the coordinates in which the scene describes it: at its centre of mass and along its
  /// principal axes if it is dynamic.
  const btTransform& frame(std::size_t body) const { return frames_[body].of_body; }
  /// Where a body is as the scene describes it. Velocities are always those of the centre of mass.
  btTransform described(std::size_t body) const;
  /// Moves a body, in Bullet's eyes only, to where the scene would have described it.
  void put(std::size_t body, const btTransform& pose);

  const scenes::Scene& scene;
  const scenes::Expanded expanded;
  const Subject subject;  ///< of these two
  scenes::BulletWorld& world;
  std::uint64_t steps = 0;  ///< done
  double substep;           ///< seconds
  measure::Clock clock = measure::Clock::cpu;

  std::vector<std::unique_ptr<btTriangleInfoMap>> edges;  // meshes point to them
  scenes::ShapeSet shapes;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::unique_ptr<btTypedConstraint>> joints;
  std::unique_ptr<scenes::Multibodies> multibodies;  ///< null unless there are some
  std::vector<std::unique_ptr<btCollisionShape>> sensor_shapes;
  std::vector<std::unique_ptr<btGhostObject>> sensors;
  std::vector<Walker> walkers;
  std::vector<std::unique_ptr<btSoftBody>> soft_bodies;
  std::vector<Car> cars;
  std::vector<btCollisionObject*> objects;

  /// Of a step, and between those of each substep; within that those of its stages.
  std::vector<Hook> first, before, solver, motion, moved, after, last;
  std::uint64_t left = 0;  ///< times that a body was found outside the bounds
  QueryResults queries;
  std::vector<SwitchedOn> switched_on;
  std::vector<SensorEvent> sensor_events;     ///< of the last step, by sensor, those that left first
  std::uint64_t impulses = 0, respawned = 0;  ///< new velocities of bodies, bodies that came anew
  std::uint64_t bounced = 0;                  ///< contacts that bounced as they touched
  std::uint64_t adjusted_contacts = 0;        ///< with internal edges; meshes have a user pointer to it
  std::vector<std::uint64_t> activity;        ///< of each effect of the plan

 private:
  void add_body(const Plan& plan, const scenes::Body& description);

  struct BodyFrame {
    btTransform of_body, back;
    bool is_described;  // the two frames are one
  };

  std::vector<const scenes::BuiltShape*> built_;  // of each body
  std::vector<BodyFrame> frames_;                 // likewise
};

}  // namespace boxstream::effects
