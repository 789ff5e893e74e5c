// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <vector>

#include "simulation/engine/world_recipe.hpp"

class btRigidBody;

namespace boxstream::scenes {

/// Called in each step with its length, in seconds. Each may be null, and must not throw.
struct MotionHooks {
  std::function<void(double)> before_solver;  ///< forces and damping are in, contacts are found
  std::function<void(double)> before_motion;  ///< the solver is done and bodies have not moved yet
  std::function<void(double)> after_motion;
  /// What follows the energy of bodies: something but gravity, and a force on it, is about to change the motion of this
  /// one. May be called for a body that then is not changed, and more than once.
  std::function<void(const btRigidBody&)> acting_on;
};

/// Bullet stops a swept body where it hits, in the middle of a step, and leaves it the velocity that forces gave it for
/// the whole of it: energy that no fall paid for. Here forces act on such a body only for as long as it moved.
class HeldBack {
 public:
  using Bodies = btAlignedObjectArray<btRigidBody*>;

  /// To be called when a step of `dt` seconds begins, before forces give bodies velocities. Where it is not, less is
  /// known of the step. `acting_on`, if there is one, is called for each body that may be stopped though nothing pushes
  /// it.
  void begin_step(const Bodies& bodies, btScalar dt, const std::function<void(const btRigidBody&)>& acting_on);
  /// Right before bodies move.
  void begin_motion(const Bodies& bodies);
  /// Right after: `dt` seconds is what those moved that nothing stopped. Returns how many bodies were stopped.
  int end_motion(const Bodies& bodies, btScalar dt);

 private:
  struct Start {
    btVector3 velocity;
    double kinetic;
  };
  std::vector<Start> starts_;
  std::vector<btVector3> from_;
};

/// A Bullet world that runs only those stages of its step that the recipe asks for. What it skips would have changed
/// nothing: the trajectory is that of the plain class, as a test shows.
template <class World>
class StagedWorld final : public World {
  static constexpr bool soft = std::is_same_v<World, btSoftRigidDynamicsWorld>;

 public:
  template <class... Arguments>
  StagedWorld(const WorldRecipe& recipe, const std::function<void()>& after_pairs, const MotionHooks& hooks,
              std::uint64_t& swept_hits, Arguments... arguments)
      : World(arguments...), recipe_(recipe), after_pairs_(after_pairs), hooks_(hooks), swept_hits_(swept_hits) {}

  // Bullet does not give back those of the last step.
  ~StagedWorld() override { this->releasePredictiveContacts(); }

  // Bullet calls this once a step, between updateAabbs and dispatch.
  void computeOverlappingPairs() override {
    World::computeOverlappingPairs();
    if (after_pairs_) after_pairs_();
  }
  void performDiscreteCollisionDetection() override {
    if (recipe_.collide) World::performDiscreteCollisionDetection();
  }
  void applyGravity() override {
    if (recipe_.apply_gravity) World::applyGravity();
  }
  // Nothing here has a motion state.
  void synchronizeMotionStates() override {}

 protected:
  // Damping, and where bodies would be without contacts: swept boxes need that. Soft bodies move in it.
  void predictUnconstraintMotion(btScalar dt) override {
    if (sweeps()) held_back_.begin_step(this->m_nonStaticRigidBodies, dt, hooks_.acting_on);
    if (soft || recipe_.apply_damping || sweeps()) World::predictUnconstraintMotion(dt);
  }
  void createPredictiveContacts(btScalar dt) override {
    if (!sweeps()) return;
    World::createPredictiveContacts(dt);
    swept_hits_ += static_cast<std::uint64_t>(this->m_predictiveManifolds.size());
  }
  void solveConstraints(btContactSolverInfo& info) override {
    if (hooks_.before_solver) hooks_.before_solver(double{info.m_timeStep});
    World::solveConstraints(info);
  }
  // Velocities are those that bodies move with now.
  void integrateTransforms(btScalar dt) override {
    if (hooks_.before_motion) hooks_.before_motion(double{dt});
    if (sweeps()) held_back_.begin_motion(this->m_nonStaticRigidBodies);
    World::integrateTransforms(dt);
    if (sweeps()) swept_hits_ += static_cast<std::uint64_t>(held_back_.end_motion(this->m_nonStaticRigidBodies, dt));
    if (hooks_.after_motion) hooks_.after_motion(double{dt});
  }
  void saveKinematicState(btScalar dt) override {
    if (recipe_.move_kinematic) World::saveKinematicState(dt);
  }
  void updateActivationState(btScalar dt) override {
    if (recipe_.deactivate) World::updateActivationState(dt);
  }

 private:
  bool sweeps() { return this->getDispatchInfo().m_useContinuous; }

  WorldRecipe recipe_;
  HeldBack held_back_;
  const std::function<void()>& after_pairs_;
  const MotionHooks& hooks_;
  std::uint64_t& swept_hits_;
};

}  // namespace boxstream::scenes
