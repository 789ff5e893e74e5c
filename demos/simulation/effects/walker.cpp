// SPDX-License-Identifier: MIT
#include "simulation/effects/walker.hpp"

#include <algorithm>

#include <btBulletDynamicsCommon.h>

#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::effects {

using scenes::real;
using scenes::transform;
using scenes::vector;

Walker::Walker(const scenes::Character& description, const scenes::Vec3& gravity)
    : description_(description),
      shape_(std::make_unique<btCapsuleShape>(real(description.radius), real(description.height))),
      ghost_(std::make_unique<btPairCachingGhostObject>()) {
  ghost_->setCollisionShape(shape_.get());
  ghost_->setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
  const btVector3 up(0, 1, 0);
  controller_ =
      std::make_unique<btKinematicCharacterController>(ghost_.get(), shape_.get(), real(description.step), up);
  controller_->setGravity(vector(gravity));
  controller_->setJumpSpeed(real(description.jump_speed));
  // Only now: the controller takes z for up at first, and turns its ghost over when the axis is set.
  ghost_->setWorldTransform(transform(description.path.front(), {0, 0, 0, 1}));
  if (description.path.size() > 1) target_ = 1;
}

void Walker::steer(std::uint64_t step, double dt) {
  const btVector3& here = ghost_->getWorldTransform().getOrigin();
  btVector3 way = vector(description_.path[target_]) - here;
  way.setY(0);
  const btScalar stride = real(description_.speed * dt);
  if (way.length() <= 2 * stride) {
    target_ = (target_ + 1) % description_.path.size();
    way = vector(description_.path[target_]) - here;
    way.setY(0);
  }
  const btScalar distance = way.length();
  heading_ = distance > stride ? way / distance : btVector3(0, 0, 0);
  controller_->setWalkDirection(heading_ * stride);
  if (description_.jump_every > 0 && step % static_cast<std::uint64_t>(description_.jump_every) == 0 &&
      controller_->canJump())
    controller_->jump();
}

std::vector<int> Walker::touched(btDispatcher& dispatcher) const {
  std::vector<int> touched;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold* const manifold = dispatcher.getManifoldByIndexInternal(i);
    if (manifold->getNumContacts() == 0) continue;
    const bool first = manifold->getBody0() == ghost_.get();
    if (!first && manifold->getBody1() != ghost_.get()) continue;
    touched.push_back((first ? manifold->getBody1() : manifold->getBody0())->getUserIndex());
  }
  // The world and the ghost each keep a manifold for the same two.
  std::sort(touched.begin(), touched.end());
  touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
  return touched;
}

void Walker::push(const SceneInstance& instance, double dt) const {
  if (description_.push == 0) return;
  for (const int index : touched(instance.world.dispatcher())) {
    btRigidBody* const body = btRigidBody::upcast(instance.objects[static_cast<std::size_t>(index)]);
    if (body == nullptr || body->isStaticOrKinematicObject()) continue;
    instance.acting_on(*body);
    body->activate();
    body->applyCentralImpulse(heading_ * real(description_.push * dt));
  }
}

}  // namespace boxstream::effects
