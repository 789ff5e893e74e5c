// SPDX-License-Identifier: MIT
#include "simulation/engine/moved_apart.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

namespace boxstream::scenes {
namespace {

// Metres, which is Bullet's own bound, and a share of the thinner of two bodies.
constexpr double deep = 0.04, deep_share = 0.04;
// What has come deep is moved apart until this much of it is left: at the bound itself it would get its speed after
// all.
constexpr float left = 0.03125F;

constexpr auto infinite = std::numeric_limits<btScalar>::max();

// Nothing in Bullet uses these two numbers of a manifold: how deep it has been, and how deep it was at the last look.
float kept_depth(const btPersistentManifold& manifold) {
  return std::bit_cast<float>(manifold.m_companionIdA);
}
float last_depth(const btPersistentManifold& manifold) {
  return std::bit_cast<float>(manifold.m_companionIdB);
}
void keep_depths(btPersistentManifold& manifold, float kept, float last) {
  manifold.m_companionIdA = std::bit_cast<int>(kept);
  manifold.m_companionIdB = std::bit_cast<int>(last);
}

}  // namespace

double deep_from(double thickness, double other) {
  const auto share = [](double of) { return of > 0 ? deep_share * of : deep; };
  return std::min({deep, share(thickness), share(other)});
}

double MovedApart::thickness_of(const btCollisionObject& object) const {
  const auto index = static_cast<std::size_t>(object.getUserIndex());
  return index < bodies_.thickness.size() ? bodies_.thickness[index] : 0;
}

double MovedApart::bound(const btPersistentManifold& manifold) const {
  return deep_from(thickness_of(*manifold.getBody0()), thickness_of(*manifold.getBody1()));
}

btScalar MovedApart::deepest_push(const btPersistentManifold& manifold) const {
  return static_cast<btScalar>(bound(manifold));
}

btScalar MovedApart::threshold(btPersistentManifold& manifold) const {
  if (!bodies_.have_weight) return 0;
  float depth = 0;
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    // The velocity of a bounce comes from the speed of the impact, and must not have a part for depth in it.
    if (point.m_combinedRestitution > 0) return 0;
    depth = std::max(depth, static_cast<float>(-point.getDistance()));
  }
  const auto bound = static_cast<float>(this->bound(manifold));
  // What sinks in little by little is under a load, which velocities bear better.
  const bool is_sudden = depth - last_depth(manifold) > bound / 2;
  float kept = kept_depth(manifold);
  if (depth > bound && (is_sudden || kept > 0))
    kept = std::max(kept, depth);
  else if (depth < left * kept)
    kept = 0;
  keep_depths(manifold, kept, depth);
  if (kept == 0) return -infinite;
  return -static_cast<btScalar>(std::min(bound, left * kept));
}

}  // namespace boxstream::scenes
