// SPDX-License-Identifier: MIT
#include "simulation/run/state_hash.hpp"

#include <BulletDynamics/Dynamics/btRigidBody.h>
#include <BulletSoftBody/btSoftBody.h>
#include <xxhash.h>

namespace boxstream::scenes {
namespace {

// The fourth component of Bullet's vectors is padding.
void put(const btVector3& v, std::vector<btScalar>& out) {
  out.insert(out.end(), {v.x(), v.y(), v.z()});
}

}  // namespace

void collect_state(const std::vector<btCollisionObject*>& objects, std::vector<btScalar>& out) {
  out.clear();
  out.reserve(objects.size() * 18);
  for (const btCollisionObject* const object : objects) {
    const btTransform& place = object->getWorldTransform();
    put(place.getOrigin(), out);
    for (int row = 0; row < 3; ++row) put(place.getBasis()[row], out);
    if (const btRigidBody* const body = btRigidBody::upcast(object)) {
      put(body->getLinearVelocity(), out);
      put(body->getAngularVelocity(), out);
    } else if (const btSoftBody* const soft = btSoftBody::upcast(object)) {
      for (int i = 0; i < soft->m_nodes.size(); ++i) {
        put(soft->m_nodes[i].m_x, out);
        put(soft->m_nodes[i].m_v, out);
      }
    }
  }
}

std::uint64_t hash_of(const std::vector<btScalar>& numbers) {
  return XXH3_64bits(numbers.data(), numbers.size() * sizeof(btScalar));
}

}  // namespace boxstream::scenes
