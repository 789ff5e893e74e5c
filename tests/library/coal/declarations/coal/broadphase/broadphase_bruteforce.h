// SPDX-License-Identifier: MIT
// Not Coal: see ../../README.md.
#pragma once

#include <algorithm>

#include "coal/broadphase/broadphase_collision_manager.h"

namespace coal {

/// A list of objects, with no queries.
class NaiveCollisionManager : public BroadPhaseCollisionManager {
 public:
  void registerObject(CollisionObject* object) override { objects_.push_back(object); }
  void unregisterObject(CollisionObject* object) override {
    objects_.erase(std::remove(objects_.begin(), objects_.end(), object), objects_.end());
  }
  void setup() override {}
  void update() override {}
  void clear() override { objects_.clear(); }
  void getObjects(std::vector<CollisionObject*>& objects) const override { objects = objects_; }
  void collide(CollisionObject*, CollisionCallBackBase*) const override {}
  void distance(CollisionObject*, DistanceCallBackBase*) const override {}
  void collide(CollisionCallBackBase*) const override {}
  void distance(DistanceCallBackBase*) const override {}
  void collide(BroadPhaseCollisionManager*, CollisionCallBackBase*) const override {}
  void distance(BroadPhaseCollisionManager*, DistanceCallBackBase*) const override {}
  bool empty() const override { return objects_.empty(); }
  std::size_t size() const override { return objects_.size(); }

 private:
  std::vector<CollisionObject*> objects_;
};

}  // namespace coal
