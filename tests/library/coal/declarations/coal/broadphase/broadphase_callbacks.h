// SPDX-License-Identifier: MIT
// Not Coal: see ../../README.md.
#pragma once

#include "coal/collision_object.h"

namespace coal {

struct CollisionCallBackBase {
  virtual ~CollisionCallBackBase() = default;
  virtual void init() {}
  virtual bool collide(CollisionObject* o1, CollisionObject* o2) = 0;
  virtual bool operator()(CollisionObject* o1, CollisionObject* o2) { return collide(o1, o2); }
};

struct DistanceCallBackBase {
  virtual ~DistanceCallBackBase() = default;
  virtual void init() {}
  virtual bool distance(CollisionObject* o1, CollisionObject* o2, CoalScalar& dist) = 0;
  virtual bool operator()(CollisionObject* o1, CollisionObject* o2, CoalScalar& dist) { return distance(o1, o2, dist); }
};

}  // namespace coal
