// SPDX-License-Identifier: MIT
#include "pictures/viewer/snapshot.hpp"

#include <BulletSoftBody/btSoftBody.h>
#include <btBulletDynamicsCommon.h>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>

#include "simulation/engine/convert.hpp"

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
    case State::wheel:
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
  return scenes::plain(q);
}

Pose pose_of(const btTransform& place, const Pose& former) {
  return {point(place.getOrigin()), rotation_of(place.getBasis(), former.rotation)};
}

constexpr Snapshot::Box no_box{{1, 1, 1}, {-1, -1, -1}};

/// Bullet's island tags change from step to step even where islands do not; their first members rarely do.
void name_by_first_member(std::vector<std::int32_t>& islands) {
  std::unordered_map<std::int32_t, std::int32_t> first_members;
  for (std::size_t i = 0; i < islands.size(); ++i)
    if (islands[i] >= 0) islands[i] = first_members.emplace(islands[i], static_cast<std::int32_t>(i)).first->second;
}

}  // namespace

void Snapshot::read(const scenes::Simulation& simulation, const Model& model) {
  const std::vector<btCollisionObject*>& objects = simulation.objects();
  const Kept& kept = model.kept;
  if (objects.size() != kept.in_world)
    throw std::runtime_error("objects came or went while the run was recorded, which recordings cannot show");
  poses.resize(model.states.size());
  moods.resize(model.states.size(), Mood::wheel);
  islands.resize(model.states.size(), -1);
  boxes.resize(model.states.size(), no_box);
  nodes.clear();
  for (std::size_t i = 0; i < kept.objects.size(); ++i) {
    const btCollisionObject& object = *objects[kept.objects[i]];
    moods[i] = mood_of(object, model.states[i]);
    islands[i] = object.getIslandTag();
    const btBroadphaseProxy* const proxy = object.getBroadphaseHandle();
    boxes[i] = proxy ? Box{point(proxy->m_aabbMin), point(proxy->m_aabbMax)} : no_box;
    if (const btSoftBody* const soft = btSoftBody::upcast(&object)) {
      for (int n = 0; n < soft->m_nodes.size(); ++n) nodes.push_back(point(soft->m_nodes[n].m_x));
      continue;
    }
    poses[i] = pose_of(simulation.pose(kept.objects[i]), poses[i]);
  }
  std::size_t wheel = kept.objects.size();
  simulation.for_each_wheel([&](const btTransform& place, float) {
    poses[wheel] = pose_of(place, poses[wheel]);
    ++wheel;
  });
  name_by_first_member(islands);
  kept.places_of(simulation.pairs(), pairs);
}

void Snapshot::read_contacts(const scenes::Simulation& simulation, const Model& model) {
  contacts.clear();
  const btDispatcher& dispatcher = *simulation.world().getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *const_cast<btDispatcher&>(dispatcher).getManifoldByIndexInternal(i);
    const std::uint32_t a = model.kept.place_of(static_cast<std::uint32_t>(manifold.getBody0()->getUserIndex()));
    if (a == Kept::none) continue;
    const std::uint32_t b = model.kept.place_of(static_cast<std::uint32_t>(manifold.getBody1()->getUserIndex()));
    if (b == Kept::none) continue;
    for (int k = 0; k < manifold.getNumContacts(); ++k) {
      const btManifoldPoint& at = manifold.getContactPoint(k);
      if (at.getDistance() > 0) continue;
      const btVector3 normal = a < b ? at.m_normalWorldOnB : -at.m_normalWorldOnB;
      const btVector3 middle = (at.getPositionWorldOnA() + at.getPositionWorldOnB()) / 2;
      contacts.push_back({{std::min(a, b), std::max(a, b)}, point(middle), point(normal)});
    }
  }
  std::stable_sort(contacts.begin(), contacts.end(),
                   [](const Contact& x, const Contact& y) { return x.objects < y.objects; });
}

namespace {

constexpr std::size_t one_astray_in = 100;
// Boxes without an end reach further.
constexpr float far_away = 1e15F;

bool has_end(const Snapshot::Box& box) {
  for (std::size_t d = 0; d < 3; ++d)
    if (!(box.min[d] <= box.max[d] && box.min[d] > -far_away && box.max[d] < far_away)) return false;
  return true;
}

std::vector<Snapshot::Box> boxes_of(const Snapshot& snapshot, bool all) {
  std::vector<Snapshot::Box> boxes;
  for (std::size_t i = 0; i < snapshot.boxes.size(); ++i)
    if ((all || snapshot.moods[i] != Mood::fixed) && has_end(snapshot.boxes[i])) boxes.push_back(snapshot.boxes[i]);
  return boxes;
}

/// The value that `rank` of `values` are below.
float ranked(std::vector<float>& values, std::size_t rank) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

Snapshot::Box crowd_of(const Snapshot& snapshot) {
  std::vector<Snapshot::Box> boxes = boxes_of(snapshot, false);
  if (boxes.empty()) boxes = boxes_of(snapshot, true);
  if (boxes.empty()) return {{-1, -1, -1}, {1, 1, 1}};
  const std::size_t astray = boxes.size() / one_astray_in;
  Snapshot::Box crowd;
  std::vector<float> values(boxes.size());
  for (std::size_t d = 0; d < 3; ++d) {
    std::transform(boxes.begin(), boxes.end(), values.begin(), [d](const auto& box) { return box.min[d]; });
    crowd.min[d] = ranked(values, astray);
    std::transform(boxes.begin(), boxes.end(), values.begin(), [d](const auto& box) { return box.max[d]; });
    crowd.max[d] = ranked(values, boxes.size() - 1 - astray);
  }
  return crowd;
}

Point first_eye(const Snapshot::Box& crowd) {
  // A window that is half as wide again as it is high has the camera about so far away, in diagonals of a cube.
  constexpr double away = 1.4;
  double diagonal = 0, length = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    diagonal = std::hypot(diagonal, static_cast<double>(crowd.max[d]) - crowd.min[d]);
    length = std::hypot(length, double{first_direction[d]});
  }
  Point eye;
  for (std::size_t d = 0; d < 3; ++d) {
    const double middle = (static_cast<double>(crowd.min[d]) + crowd.max[d]) / 2;
    eye[d] = static_cast<float>(middle + away * diagonal * first_direction[d] / length);
  }
  return eye;
}

}  // namespace boxstream::view
