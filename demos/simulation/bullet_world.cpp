// SPDX-License-Identifier: MIT
#include "simulation/bullet_world.hpp"

#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include "simulation/convert.hpp"
#include "simulation/end_all_pairs.hpp"

namespace boxstream::scenes {
namespace {

/// Bullet calls computeOverlappingPairs once a step, between updateAabbs and the dispatch; it is virtual.
template <class World>
class Observed final : public World {
 public:
  template <class... Arguments>
  explicit Observed(const std::function<void()>& after_pairs, Arguments... arguments)
      : World(arguments...), after_pairs_(after_pairs) {}

  void computeOverlappingPairs() override {
    World::computeOverlappingPairs();
    if (after_pairs_) after_pairs_();
  }

 private:
  const std::function<void()>& after_pairs_;
};

}  // namespace

BulletWorld::BulletWorld(const Scene& scene, std::unique_ptr<btBroadphaseInterface> broadphase)
    : broadphase_(std::move(broadphase)) {
  const bool soft = !scene.soft_bodies.empty();
  configuration_ = soft ? std::make_unique<btSoftBodyRigidBodyCollisionConfiguration>()
                        : std::make_unique<btDefaultCollisionConfiguration>();
  dispatcher_ = std::make_unique<btCollisionDispatcher>(configuration_.get());
  if (!scene.sensors.empty() || !scene.characters.empty()) {
    ghost_callback_ = std::make_unique<btGhostPairCallback>();
    broadphase_->getOverlappingPairCache()->setInternalGhostPairCallback(ghost_callback_.get());
  }
  solver_ = std::make_unique<btSequentialImpulseConstraintSolver>();
  if (soft) {
    auto world = std::make_unique<Observed<btSoftRigidDynamicsWorld>>(after_pairs, dispatcher_.get(), broadphase_.get(),
                                                                      solver_.get(), configuration_.get());
    soft_world_ = world.get();
    world_ = std::move(world);
  } else {
    world_ = std::make_unique<Observed<btDiscreteDynamicsWorld>>(after_pairs, dispatcher_.get(), broadphase_.get(),
                                                                 solver_.get(), configuration_.get());
  }
  world_->setGravity(vector(scene.world.gravity));
  btContactSolverInfo& info = world_->getSolverInfo();
  info.m_numIterations = scene.solver.iterations;
  info.m_splitImpulse = scene.solver.split_impulse;
  if (scene.solver.cache_friction) info.m_solverMode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
  if (soft_world_ != nullptr) soft_world_->getWorldInfo().m_gravity = vector(scene.world.gravity);
}

void BulletWorld::end_all_pairs() {
  EndAllPairs end_all;
  broadphase_->getOverlappingPairCache()->processAllOverlappingPairs(&end_all, dispatcher_.get());
}

}  // namespace boxstream::scenes
