// SPDX-License-Identifier: MIT
#include "pictures/viewer/snapshot.hpp"

#include <stdexcept>
#include <unordered_map>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <BulletSoftBody/btSoftBody.h>

namespace boxstream::view {
namespace {

using State = scenes::Drawable::State;

Point point(const btVector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

Mood mood_of(const btCollisionObject& object, State first) {
  if (object.getBroadphaseHandle() == nullptr) return Mood::gone;
  switch (first) {
    case State::soft:
      return Mood::soft;
    case State::sensor:
      return Mood::sensor;
    case State::character:
      return Mood::character;
    case State::fixed:
    case State::kinematic:
    case State::moving:
    case State::sleeping:
      break;
  }
  if (object.isStaticObject()) return Mood::fixed;
  if (object.isKinematicObject()) return Mood::kinematic;
  return object.isActive() ? Mood::moving : Mood::sleeping;
}

/// The rotation of `basis`, with the sign that is nearer to `former`.
Rotation rotation_of(const btMatrix3x3& basis, const Rotation& former) {
  btQuaternion q;
  basis.getRotation(q);
  q.safeNormalize();
  const btQuaternion before(former[0], former[1], former[2], former[3]);
  if (q.dot(before) < 0) q = -q;
  return {q.x(), q.y(), q.z(), q.w()};
}

/// Bullet's island tags change from step to step even where islands do not; their first members rarely do.
void name_by_first_member(std::vector<std::int32_t>& islands) {
  std::unordered_map<std::int32_t, std::int32_t> first_members;
  for (std::size_t i = 0; i < islands.size(); ++i)
    if (islands[i] >= 0) islands[i] = first_members.emplace(islands[i], static_cast<std::int32_t>(i)).first->second;
}

}  // namespace

void Snapshot::read(const scenes::Simulation& simulation, const Model& model) {
  const std::vector<btCollisionObject*>& objects = simulation.objects();
  if (objects.size() != model.states.size())
    throw std::runtime_error("objects came or went while the run was recorded, which recordings cannot show");
  poses.resize(objects.size());
  moods.resize(objects.size());
  islands.resize(objects.size());
  boxes.resize(objects.size());
  nodes.clear();
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const btCollisionObject& object = *objects[i];
    moods[i] = mood_of(object, model.states[i]);
    islands[i] = object.getIslandTag();
    const btBroadphaseProxy* const proxy = object.getBroadphaseHandle();
    boxes[i] = proxy ? Box{point(proxy->m_aabbMin), point(proxy->m_aabbMax)} : Box{{1, 1, 1}, {-1, -1, -1}};
    if (const btSoftBody* const soft = btSoftBody::upcast(&object)) {
      for (int n = 0; n < soft->m_nodes.size(); ++n) nodes.push_back(point(soft->m_nodes[n].m_x));
      continue;
    }
    const btTransform& place = object.getWorldTransform();
    poses[i] = {point(place.getOrigin()), rotation_of(place.getBasis(), poses[i].rotation)};
  }
  name_by_first_member(islands);
  pairs = simulation.pairs();
}

}  // namespace boxstream::view
