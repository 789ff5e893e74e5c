// SPDX-License-Identifier: MIT
#include <utility>

#include <BulletCollision/BroadphaseCollision/btBroadphaseInterface.h>
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include "formats/record/forwarding_broadphase.hpp"
#include "simulation/engine/broadphases.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes {

struct Shadow::Impl {
  const Simulation& simulation;
  std::unique_ptr<btBroadphaseInterface> broadphase;
  std::vector<btBroadphaseProxy*> proxies;  // null where the object is not in the world

  /// Does with its own proxy what became of the original.
  void copy(std::size_t object);
};

Shadow::Shadow(const Simulation& simulation, const std::string& name)
    : impl_(std::make_unique<Impl>(
          Impl{simulation, make_broadphase(name, simulation.scene().world.bounds, simulation.objects().size()),
               std::vector<btBroadphaseProxy*>(simulation.objects().size())})) {
  for (std::size_t i = 0; i < impl_->proxies.size(); ++i) impl_->copy(i);
}

Shadow::~Shadow() {
  // Bullet's broad-phases leave proxies behind, and scan all pairs for each proxy that is destroyed: so pairs first.
  EndAllPairs end_all;
  impl_->broadphase->getOverlappingPairCache()->processAllOverlappingPairs(&end_all, nullptr);
  for (btBroadphaseProxy* const proxy : impl_->proxies)
    if (proxy != nullptr) impl_->broadphase->destroyProxy(proxy, nullptr);
}

void Shadow::Impl::copy(std::size_t i) {
  btCollisionObject* const object = simulation.objects()[i];
  const btBroadphaseProxy* const original = object->getBroadphaseHandle();
  btBroadphaseProxy*& proxy = proxies[i];
  if (original == nullptr) {
    if (proxy != nullptr) broadphase->destroyProxy(std::exchange(proxy, nullptr), nullptr);
  } else if (proxy == nullptr) {
    proxy =
        broadphase->createProxy(original->m_aabbMin, original->m_aabbMax, object->getCollisionShape()->getShapeType(),
                                object, original->m_collisionFilterGroup, original->m_collisionFilterMask, nullptr);
  } else {
    broadphase->setAabb(proxy, original->m_aabbMin, original->m_aabbMax, nullptr);
  }
}

void Shadow::follow() {
  for (std::size_t i = 0; i < impl_->proxies.size(); ++i) impl_->copy(i);
  impl_->broadphase->calculateOverlappingPairs(nullptr);
}

std::vector<Pair> Shadow::pairs() const {
  std::vector<Pair> pairs;
  list_pairs(*impl_->broadphase, pairs);
  return pairs;
}

}  // namespace boxstream::scenes
