// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/part_contacts.hpp"

#include <algorithm>
#include <utility>

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <LinearMath/btAabbUtil2.h>

namespace boxstream::scenes {

PartContacts::PartContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper*,
                           const btCollisionObjectWrapper*, bool turned)
    : btCollisionAlgorithm(info), shared_(info.m_manifold), turned_(turned) {}

PartContacts::~PartContacts() {
  for (btCollisionAlgorithm*& part : parts_) drop(part);
}

void PartContacts::drop(btCollisionAlgorithm*& part) {
  if (part == nullptr) return;
  part->~btCollisionAlgorithm();
  m_dispatcher->freeCollisionAlgorithm(part);
  part = nullptr;
}

void PartContacts::getAllContactManifolds(btManifoldArray& manifolds) {
  for (btCollisionAlgorithm* const part : parts_)
    if (part != nullptr) part->getAllContactManifolds(manifolds);
}

void PartContacts::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                    const btDispatcherInfo& info, btManifoldResult* result) {
  if (turned_) std::swap(a, b);
  const auto& compound = static_cast<const btCompoundShape&>(*a->getCollisionShape());
  parts_.resize(static_cast<std::size_t>(compound.getNumChildShapes()));
  const auto reach_of = [](const btCollisionObjectWrapper& wrap) {
    return wrap.getCollisionShape()->getContactBreakingThreshold(gContactBreakingThreshold);
  };
  const btScalar reach = std::min(reach_of(*a), reach_of(*b)) + result->m_closestPointDistanceThreshold;
  const btVector3 margin(reach, reach, reach);
  btVector3 other_low, other_high;
  b->getCollisionShape()->getAabb(b->getWorldTransform(), other_low, other_high);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    btCollisionAlgorithm*& part = parts_[static_cast<std::size_t>(i)];
    const btCollisionShape* const shape = compound.getChildShape(i);
    const btTransform place = a->getWorldTransform() * compound.getChildTransform(i);
    btVector3 low, high;
    shape->getAabb(place, low, high);
    if (!TestAabbAgainstAabb2(low - margin, high + margin, other_low, other_high)) {
      drop(part);
      continue;
    }
    const btCollisionObjectWrapper wrap(a, shape, a->getCollisionObject(), place, -1, i);
    if (part == nullptr) part = m_dispatcher->findAlgorithm(&wrap, b, shared_, BT_CONTACT_POINT_ALGORITHMS);
    const bool is_first = result->getBody0Internal() == a->getCollisionObject();
    const btCollisionObjectWrapper* const former = is_first ? result->getBody0Wrap() : result->getBody1Wrap();
    if (is_first) {
      result->setBody0Wrap(&wrap);
      result->setShapeIdentifiersA(-1, i);
    } else {
      result->setBody1Wrap(&wrap);
      result->setShapeIdentifiersB(-1, i);
    }
    part->processCollision(&wrap, b, info, result);
    if (is_first)
      result->setBody0Wrap(former);
    else
      result->setBody1Wrap(former);
  }
}

}  // namespace boxstream::scenes
