// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>

namespace boxstream::scenes {

/// Contacts of a compound, part by part. Bullet's own algorithm drops those of a part as soon as its box does not touch
/// the other's, however near the two are, and all contacts begin anew. `turned`: the compound comes second.
class PartContacts final : public btCollisionAlgorithm {
 public:
  PartContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
               const btCollisionObjectWrapper* b, bool turned);
  ~PartContacts() override;

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override;

 private:
  void drop(btCollisionAlgorithm*& part);

  std::vector<btCollisionAlgorithm*> parts_;  // null where a part is not near
  btPersistentManifold* shared_;
  bool turned_;
};

}  // namespace boxstream::scenes
