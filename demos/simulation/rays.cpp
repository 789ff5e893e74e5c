// SPDX-License-Identifier: MIT
#include "simulation/rays.hpp"

#include <cmath>
#include <numbers>

#include <BulletCollision/CollisionDispatch/btCollisionWorld.h>

#include "simulation/convert.hpp"

namespace boxstream::scenes {

std::uint64_t cast_rays(const RayFan& fan, std::uint64_t step, const btCollisionWorld& world) {
  const double turned = static_cast<double>(step) * fan.degrees * std::numbers::pi / 180;
  const btVector3 from = vector(fan.from);
  std::uint64_t hits = 0;
  for (int i = 0; i < fan.count; ++i) {
    const double angle = turned + 2 * std::numbers::pi * i / fan.count;
    const btVector3 to =
        from + btVector3(real(fan.radius * std::cos(angle)), real(-fan.drop), real(fan.radius * std::sin(angle)));
    btCollisionWorld::ClosestRayResultCallback nearest(from, to);
    world.rayTest(from, to, nearest);
    hits += nearest.hasHit();
  }
  return hits;
}

}  // namespace boxstream::scenes
