// SPDX-License-Identifier: MIT
// Not Coal: see ../../README.md.
#pragma once

#include <vector>

#include "coal/broadphase/broadphase_callbacks.h"

namespace coal {

class BroadPhaseCollisionManager {
 public:
  virtual ~BroadPhaseCollisionManager() = default;
  virtual void registerObjects(const std::vector<CollisionObject*>&) {}
  virtual void registerObject(CollisionObject*) = 0;
  virtual void unregisterObject(CollisionObject*) = 0;
  virtual void setup() = 0;
  virtual void update() = 0;
  virtual void update(CollisionObject*) { update(); }
  virtual void update(const std::vector<CollisionObject*>&) { update(); }
  virtual void clear() = 0;
  virtual void getObjects(std::vector<CollisionObject*>& objs) const = 0;
  virtual std::vector<CollisionObject*> getObjects() const {
    std::vector<CollisionObject*> objects(size());
    getObjects(objects);
    return objects;
  }
  virtual void collide(CollisionObject* obj, CollisionCallBackBase* callback) const = 0;
  virtual void distance(CollisionObject* obj, DistanceCallBackBase* callback) const = 0;
  virtual void collide(CollisionCallBackBase* callback) const = 0;
  virtual void distance(DistanceCallBackBase* callback) const = 0;
  virtual void collide(BroadPhaseCollisionManager* other_manager, CollisionCallBackBase* callback) const = 0;
  virtual void distance(BroadPhaseCollisionManager* other_manager, DistanceCallBackBase* callback) const = 0;
  virtual bool empty() const = 0;
  virtual std::size_t size() const = 0;
};

}  // namespace coal
