// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>

#include "formats/scene_model/scene.hpp"

class btDispatcher;

namespace boxstream::effects {

struct SceneInstance;

/// One character of a scene: Bullet's kinematic character controller on a pair-caching ghost, walked along its path.
/// Does not add itself to a world.
class Walker {
 public:
  Walker(const scenes::Character& description, const scenes::Vec3& gravity);

  btPairCachingGhostObject& ghost() { return *ghost_; }
  const btPairCachingGhostObject& ghost() const { return *ghost_; }
  btKinematicCharacterController& controller() { return *controller_; }

  /// Before a step: heads for the next waypoint when this one is reached, and jumps when it is time.
  void steer(std::uint64_t step, double dt);
  bool is_walking() const { return !heading_.isZero(); }
  /// User indices of the objects that it touches, ascending, once each.
  std::vector<int> touched(btDispatcher& dispatcher) const;
  /// After a step: pushes the dynamic bodies that it touches the way it walks.
  void push(const SceneInstance& instance, double dt) const;

 private:
  scenes::Character description_;
  std::size_t target_ = 0;
  btVector3 heading_{0, 0, 0};
  std::unique_ptr<btConvexShape> shape_;
  std::unique_ptr<btPairCachingGhostObject> ghost_;
  std::unique_ptr<btKinematicCharacterController> controller_;
};

}  // namespace boxstream::effects
