// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <functional>
#include <memory>
#include <vector>

#include "simulation/engine/joint_trees.hpp"
#include "simulation/engine/link_joint.hpp"
#include "simulation/engine/midpoint.hpp"

namespace boxstream::scenes {

/// Bullet's world of multibodies, with a place between its own accelerations and its solver.
class MultibodyWorld : public btMultiBodyDynamicsWorld {
 public:
  using btMultiBodyDynamicsWorld::btMultiBodyDynamicsWorld;

  void solveExternalForces(btContactSolverInfo& info) override {
    btMultiBodyDynamicsWorld::solveExternalForces(info);
    if (after_forces) after_forces();
  }

  std::function<void()> after_forces;  ///< velocities have forces in them, and nothing of the solver yet
};

}  // namespace boxstream::scenes

class btMultiBodyConstraint;
class btMultiBodyJointMotor;

namespace boxstream::scenes {

class MultibodyWorld;

/// Trees of bodies and joints as Bullet's multibodies: their coordinates are the base's pose and the angles and ways of
/// the joints, which cannot come apart. Each body stays as what the rest of a program sees of its link, outside of the
/// engine's steps: it has the link's pose, velocities and box, and what is done to it (forces, torques, changes of
/// velocity, waking it up) is done to the link with the next step.
class Multibodies {
 public:
  using Bodies = std::vector<std::unique_ptr<btRigidBody>>;

  /// Takes the bodies of the trees out of the world, and puts links into it. `joints[i]` is there for each joint that a
  /// tree holds. `damped`: whether bodies lose speed by their coefficients; `may_sleep`: whether anything falls asleep.
  /// Throws std::invalid_argument for what Bullet's multibodies cannot compute: one line that names the body.
  Multibodies(MultibodyWorld& world, const JointTrees& trees, const std::vector<std::optional<LinkJoint>>& joints,
              const Bodies& bodies, bool damped, bool may_sleep);
  /// Takes them out again; the bodies are in no world then.
  ~Multibodies();
  Multibodies(const Multibodies&) = delete;
  Multibodies& operator=(const Multibodies&) = delete;

  /// To be called before each step of `dt` seconds; before velocities change in it; when the solver is done; and when
  /// all has moved.
  void before_step(double dt);
  void before_solver(double dt);
  void before_motion();
  void after_motion();

  /// Joules, of motors, in all steps.
  double work_of_motors() const { return work_; }
  /// Links that have moved, in all steps.
  std::uint64_t moved() const { return moved_; }

 private:
  class Collider;
  struct Part {
    btRigidBody* body;
    int link;  ///< -1: the base
    std::unique_ptr<Collider> collider;
    btVector3 velocity{0, 0, 0}, spin{0, 0, 0};  ///< as the link last had them
  };
  struct Motor {
    std::unique_ptr<btMultiBodyJointMotor> motor;
    int link;
    double force;  ///< the most it has, in N or N m
    btScalar before = 0;
  };
  struct Tree {
    std::unique_ptr<btMultiBody> multibody;
    std::unique_ptr<Midpoint> motion;
    std::vector<Part> parts;
    std::vector<Motor> motors;
    std::vector<std::unique_ptr<btMultiBodyConstraint>> constraints;

    bool is_asleep() const;
  };

  void add_links(const JointTrees::Tree& description, const std::vector<std::optional<LinkJoint>>& joints,
                 const Bodies& bodies, Tree& tree);
  void add_colliders(Tree& tree, bool may_sleep);
  void add_rows(const JointTrees& trees, const JointTrees::Tree& description,
                const std::vector<std::optional<LinkJoint>>& joints, Tree& tree);
  /// Gives links the velocities of their bodies, as far as joints let them have those.
  void take_velocities(Tree& tree);
  void show(Tree& tree);
  template <class Do>
  void for_each_awake(Do what);

  MultibodyWorld& world_;
  std::vector<Tree> trees_;
  bool damped_;
  double work_ = 0;
  std::uint64_t moved_ = 0;
  btAlignedObjectArray<btScalar> scalars_;
  btAlignedObjectArray<btVector3> vectors_;
  btAlignedObjectArray<btMatrix3x3> matrices_;
  btAlignedObjectArray<btQuaternion> turns_;
};

}  // namespace boxstream::scenes
