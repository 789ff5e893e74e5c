// SPDX-License-Identifier: MIT
#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include "simulation/broadphases.hpp"
#include "simulation/end_all_pairs.hpp"
#include "simulation/pair_check.hpp"
#include "simulation/pair_list.hpp"
#include "simulation/simulation.hpp"

namespace boxstream::scenes {

struct Shadow::Impl {
  const Simulation& simulation;
  std::unique_ptr<btBroadphaseInterface> broadphase;
  std::vector<btBroadphaseProxy*> proxies;
};

Shadow::Shadow(const Simulation& simulation, const std::string& name)
    : impl_(std::make_unique<Impl>(
          Impl{simulation, make_broadphase(name, simulation.scene().world.bounds, simulation.objects().size()), {}})) {
  for (btCollisionObject* const object : simulation.objects()) {
    const btBroadphaseProxy& original = *object->getBroadphaseHandle();
    impl_->proxies.push_back(impl_->broadphase->createProxy(
        original.m_aabbMin, original.m_aabbMax, object->getCollisionShape()->getShapeType(), object,
        original.m_collisionFilterGroup, original.m_collisionFilterMask, nullptr));
  }
}

Shadow::~Shadow() {
  // Bullet's broad-phases leave proxies behind, and scan all pairs for each proxy that is destroyed: so pairs first.
  EndAllPairs end_all;
  impl_->broadphase->getOverlappingPairCache()->processAllOverlappingPairs(&end_all, nullptr);
  for (btBroadphaseProxy* const proxy : impl_->proxies) impl_->broadphase->destroyProxy(proxy, nullptr);
}

void Shadow::follow() {
  const std::vector<btCollisionObject*>& objects = impl_->simulation.objects();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const btBroadphaseProxy& original = *objects[i]->getBroadphaseHandle();
    impl_->broadphase->setAabb(impl_->proxies[i], original.m_aabbMin, original.m_aabbMax, nullptr);
  }
  impl_->broadphase->calculateOverlappingPairs(nullptr);
}

std::vector<Pair> Shadow::pairs() const {
  std::vector<Pair> pairs;
  list_pairs(*impl_->broadphase, pairs);
  return pairs;
}

}  // namespace boxstream::scenes
