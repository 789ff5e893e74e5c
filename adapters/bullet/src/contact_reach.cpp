// SPDX-License-Identifier: MIT
#include "contact_reach.hpp"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

void ContactReach::measure(Proxy& proxy, const void* shape, const btVector3& lo, const btVector3& hi) const {
  btScalar disc = shape != nullptr ? static_cast<const btCollisionShape*>(shape)->getAngularMotionDisc() : btScalar(0);
  const boxstream::detail::DefaultFloatEnvironment environment;
  if (shape == nullptr) disc = (hi - lo).length() / 2;
  const btScalar missing = std::min(gContactBreakingThreshold * (disc / 2 - 1), gDbvtMargin);
  proxy.margin = missing > margin_ ? missing : margin_;  // the latter if the former is not a number
  proxy.sized_shape = shape;
  proxy.moves_until_sized = moves_between_sizes;
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
