// SPDX-License-Identifier: MIT
// Preloaded into a program that has Bullet in single precision: the manifolds of each step come in the order of their
// objects in the world, whatever broad-phase found the pairs. What the program prints on btDbvtBroadphase and on
// boxstream is then the same to the last bit; without it only the order of contacts differs, which solvers amplify.
#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cstring>
#include <typeinfo>
#include <utility>

namespace {

std::pair<int, int> objects_of(const btPersistentManifold* manifold) {
  return std::minmax(manifold->getBody0()->getWorldArrayIndex(), manifold->getBody1()->getWorldArrayIndex());
}

/// By name: a cast needs a symbol of a library that not every program loads.
bool has_islands(const btCollisionWorld& world) {
  return std::strcmp(typeid(world).name(), "23btDiscreteDynamicsWorld") == 0;
}

}  // namespace

// In place of Bullet's, which does the first three of these.
void btCollisionWorld::performDiscreteCollisionDetection() {
  updateAabbs();
  computeOverlappingPairs();
  m_dispatcher1->dispatchAllCollisionPairs(getPairCache(), getDispatchInfo(), m_dispatcher1);
  btPersistentManifold** const manifolds = m_dispatcher1->getInternalManifoldPointer();
  const int count = m_dispatcher1->getNumManifolds();
  std::stable_sort(manifolds, manifolds + count,
                   [](const auto* a, const auto* b) { return objects_of(a) < objects_of(b); });
  for (int i = 0; i < count; ++i) manifolds[i]->m_index1a = i;
  // Islands are made from pairs, and btDbvtBroadphase has pairs of objects that do not touch.
  if (has_islands(*this))
    static_cast<btDiscreteDynamicsWorld*>(this)->getSimulationIslandManager()->setSplitIslands(false);
}
