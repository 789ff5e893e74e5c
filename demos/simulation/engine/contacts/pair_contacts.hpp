// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>

#include "simulation/engine/contacts/contact_points.hpp"

namespace boxstream::scenes {

/// Whether points of the steps before have moved aside, by a share of what Bullet drops them for.
bool has_slid(const btPersistentManifold& manifold, btScalar share);

/// Contacts of two objects in a manifold: of their own, or one that they share with other parts.
class PairContacts : public btCollisionAlgorithm {
 public:
  PairContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
               const btCollisionObjectWrapper* b);
  ~PairContacts() override;

  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (owns_) manifolds.push_back(manifold_);
  }

 protected:
  /// How near, in metres, shapes have contacts.
  double reach(const btManifoldResult& result) const;

  /// All that are found in a step, which leaves none of the manifold's former ones but those that are still there.
  /// `turned`: a and b of the points are the second and the first of the two that this was made for.
  void replace(const ContactPoints& found, const btVector3& origin, bool turned, btManifoldResult& result);
  /// Takes out those points of an own manifold that none of these takes the place of.
  void forget(const ContactPoints* found, std::size_t count, const btVector3& origin, bool turned);
  void add(const ContactPoints& found, const btVector3& origin, bool turned, btManifoldResult& result);
  void refresh(btManifoldResult& result);

  btPersistentManifold* manifold() const { return manifold_; }

 private:
  btPersistentManifold* manifold_;
  bool owns_;
};

class ConvexContacts : public PairContacts {
 public:
  using PairContacts::PairContacts;
  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo&,
                        btManifoldResult* result) override;
};

/// Of a convex shape and a half-space; `turned`: the half-space comes first.
class PlaneContacts final : public PairContacts {
 public:
  PlaneContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
                const btCollisionObjectWrapper* b, bool turned)
      : PairContacts(info, a, b), turned_(turned) {}
  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo&,
                        btManifoldResult* result) override;

 private:
  bool turned_;
};

/// Of a convex shape and one made of triangles, each of them a shape of its own; `turned`: the triangles come first.
class SurfaceContacts final : public PairContacts {
 public:
  SurfaceContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
                  const btCollisionObjectWrapper* b, bool turned)
      : PairContacts(info, turned ? b : a, turned ? a : b), turned_(turned) {}
  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, const btDispatcherInfo&,
                        btManifoldResult* result) override;

 private:
  bool turned_;
};

}  // namespace boxstream::scenes
