// SPDX-License-Identifier: MIT
#include "simulation/engine/bullet_world.hpp"

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include "formats/record/forwarding_broadphase.hpp"
#include "simulation/engine/multibodies.hpp"
#include "simulation/engine/staged_world.hpp"

namespace boxstream::scenes {

BulletWorld::BulletWorld(const WorldRecipe& recipe, std::unique_ptr<btBroadphaseInterface> broadphase)
    : broadphase_(std::move(broadphase)) {
  configuration_ = recipe.soft ? std::make_unique<btSoftBodyRigidBodyCollisionConfiguration>()
                               : std::make_unique<btDefaultCollisionConfiguration>();
  dispatcher_ = std::make_unique<btCollisionDispatcher>(configuration_.get());
  if (recipe.friction) sliding_contacts_ = std::make_unique<SlidingContacts>(*dispatcher_, *configuration_);
  if (recipe.unit_contacts)
    unit_contacts_ = std::make_unique<UnitContacts>(*dispatcher_, *configuration_, sliding_contacts_.get());
  if (recipe.ghost_pairs) {
    ghost_callback_ = std::make_unique<btGhostPairCallback>();
    broadphase_->getOverlappingPairCache()->setInternalGhostPairCallback(ghost_callback_.get());
  }
  solver_ = make_row_solver(recipe.solver_kind, recipe.friction);
  if (recipe.soft && recipe.solver_kind != SolverKind::multibodies) {
    auto world = std::make_unique<StagedWorld<btSoftRigidDynamicsWorld>>(recipe, after_pairs, hooks, swept_hits,
                                                                         dispatcher_.get(), broadphase_.get(),
                                                                         &solver_->bullet(), configuration_.get());
    soft_world_ = world.get();
    world_ = std::move(world);
  } else if (recipe.solver_kind == SolverKind::multibodies) {
    auto world = std::make_unique<StagedWorld<MultibodyWorld>>(
        recipe, after_pairs, hooks, swept_hits, dispatcher_.get(), broadphase_.get(),
        &static_cast<btMultiBodyConstraintSolver&>(solver_->bullet()), configuration_.get());
    multibody_world_ = world.get();
    world_ = std::move(world);
  } else {
    world_ = std::make_unique<StagedWorld<btDiscreteDynamicsWorld>>(recipe, after_pairs, hooks, swept_hits,
                                                                    dispatcher_.get(), broadphase_.get(),
                                                                    &solver_->bullet(), configuration_.get());
  }
  set_gravity(recipe.gravity);
  world_->getSolverInfo() = recipe.solver;
  world_->getDispatchInfo().m_useContinuous = recipe.continuous;
  world_->setForceUpdateAllAabbs(recipe.force_boxes);
}

void BulletWorld::set_gravity(const btVector3& gravity) {
  world_->setGravity(gravity);
  if (soft_world_ != nullptr) soft_world_->getWorldInfo().m_gravity = gravity;
}

void BulletWorld::end_all_pairs() {
  EndAllPairs end_all;
  broadphase_->getOverlappingPairCache()->processAllOverlappingPairs(&end_all, dispatcher_.get());
}

}  // namespace boxstream::scenes
