// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <LinearMath/btAlignedObjectArray.h>

#include <boxstream/bullet.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// One of Bullet's solvers, btSequentialImpulseConstraintSolver or a class derived from it, that takes the contacts of
/// a step from the ground up:
///
///     btDiscreteDynamicsWorld world(&dispatcher, broadphase, new boxstream::bullet::LowFirst<>, &configuration);
///
/// Bullet's own order is that in which contacts began, mixed by a sort by island. From the ground up, the contacts of
/// high stacks are less deep, in whatever order their bodies were created; heaps and what falls differ by little more
/// than noise: experiment S11 of the report says by how much, and what it costs. Works with any
/// broad-phase, on one thread; the multi-threaded solvers of Bullet have an order of their own. If bodies are created
/// from the ground up, m_deterministicOverlappingPairs does the same for nothing: see Broadphase.
///
/// The order depends on heights and ids alone, so that two worlds with the same contacts solve them alike.
template <class Solver = btSequentialImpulseConstraintSolver>
class LowFirst : public Solver {
 public:
  /// `up` is the direction against gravity, of any length but 0.
  explicit LowFirst(const btVector3& up = btVector3(0, 1, 0)) : up_(up) {}

 protected:
  /// Leaves the array as it is: it may be the dispatcher's own.
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override {
    placed_.resizeNoInitialize(0);
    for (int i = 0; i < count; ++i)
      if (manifolds[i]->getNumContacts() > 0) placed_.push_back(placed(manifolds[i]));
    placed_.quickSort(comes_before);
    sorted_.resizeNoInitialize(0);
    for (int i = 0; i < placed_.size(); ++i) sorted_.push_back(placed_[i].manifold);
    Solver::convertContacts(sorted_.size() > 0 ? &sorted_[0] : manifolds, sorted_.size(), info);
  }

 private:
  struct Placed {
    btScalar height;  ///< twice that of the middle of what the boxes of the two bodies share
    int id0, id1;     ///< of the two proxies
    btPersistentManifold* manifold;
  };

  /// Heights of boxes, because those of bodies side by side are often equal, where those of their contacts seldom are:
  /// then ids decide, and bodies that were created together are visited together.
  Placed placed(btPersistentManifold* manifold) const {
    const btBroadphaseProxy& a = *manifold->getBody0()->getBroadphaseHandle();
    const btBroadphaseProxy& b = *manifold->getBody1()->getBroadphaseHandle();
    btVector3 low = a.m_aabbMin, high = a.m_aabbMax;
    low.setMax(b.m_aabbMin);
    high.setMin(b.m_aabbMax);
    return {(low + high).dot(up_), a.m_uniqueId, b.m_uniqueId, manifold};
  }

  static bool comes_before(const Placed& a, const Placed& b) {
    if (a.height != b.height) return a.height < b.height;
    return a.id0 != b.id0 ? a.id0 < b.id0 : a.id1 < b.id1;
  }

  btVector3 up_;
  btAlignedObjectArray<Placed> placed_;
  btAlignedObjectArray<btPersistentManifold*> sorted_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
