// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <type_traits>

#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

#include "simulation/engine/world_recipe.hpp"

namespace boxstream::scenes {

/// A Bullet world that runs only those stages of its step that the recipe asks for. What it skips would have changed
/// nothing: the trajectory is that of the plain class, as a test shows.
template <class World>
class StagedWorld final : public World {
  static constexpr bool soft = std::is_same_v<World, btSoftRigidDynamicsWorld>;

 public:
  template <class... Arguments>
  StagedWorld(const WorldRecipe& recipe, const std::function<void()>& after_pairs, std::uint64_t& predicted_contacts,
              Arguments... arguments)
      : World(arguments...), recipe_(recipe), after_pairs_(after_pairs), predicted_contacts_(predicted_contacts) {}

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
    if (soft || recipe_.apply_damping || sweeps()) World::predictUnconstraintMotion(dt);
  }
  void createPredictiveContacts(btScalar dt) override {
    if (!sweeps()) return;
    World::createPredictiveContacts(dt);
    predicted_contacts_ += static_cast<std::uint64_t>(this->m_predictiveManifolds.size());
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
  const std::function<void()>& after_pairs_;
  std::uint64_t& predicted_contacts_;
};

}  // namespace boxstream::scenes
