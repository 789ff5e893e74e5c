// SPDX-License-Identifier: MIT
#include "contact_reach.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

#include "client.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Null if the client is not, or not yet, the object that has this proxy.
const void* ContactReach::shape_of(const Proxy& proxy) {
  const btCollisionObject* const object = as_object(proxy.m_clientObject);
  return object != nullptr && object->getBroadphaseHandle() == &proxy ? object->getCollisionShape() : nullptr;
}

void ContactReach::measure(Proxy& proxy, const void* shape, btScalar square) const {
  btScalar disc = shape != nullptr ? static_cast<const btCollisionShape*>(shape)->getAngularMotionDisc() : btScalar(0);
  const boxstream::detail::DefaultFloatEnvironment environment;
  if (shape == nullptr) disc = btSqrt(square) / 2;
  const btScalar missing = std::min(gContactBreakingThreshold * (disc / 2 - 1), gDbvtMargin);
  proxy.margin = missing > margin_ ? missing : margin_;  // the latter if the former is not a number
  proxy.sized_shape = shape;
  proxy.sized_square = square;
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
