// SPDX-License-Identifier: MIT
#include <algorithm>

#include <BulletSoftBody/btSoftBody.h>
#include <fmt/format.h>

#include "simulation/run/simulation_parts.hpp"

namespace boxstream::scenes {
Census Simulation::census() const {
  const effects::SceneInstance& instance = impl_->instance;
  Census census;
  census.objects = instance.objects.size();
  census.bodies = instance.bodies.size();
  census.joints = instance.joints.size();
  census.sensors = instance.sensors.size();
  census.characters = instance.walkers.size();
  census.soft_bodies = instance.soft_bodies.size();
  for (const auto& soft : instance.soft_bodies) census.soft_nodes += static_cast<std::uint64_t>(soft->m_nodes.size());
  double smallest = 0, largest = 0;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    const btRigidBody& body = *instance.bodies[i];
    ++census.shapes[instance.expanded.shapes[instance.expanded.bodies[i].traits.shape].value.index()];
    // By what the scene says: Bullet's flag of a conveyor is another one.
    const BodyType type = instance.expanded.bodies[i].traits.type;
    if (type == BodyType::fixed) {
      ++census.fixed;
    } else if (type == BodyType::kinematic) {
      ++census.kinematic;
    } else {
      ++census.dynamic;
      btVector3 min, max;
      body.getCollisionShape()->getAabb(btTransform::getIdentity(), min, max);
      const double diagonal = (max - min).length();
      largest = std::max(largest, diagonal);
      smallest = smallest > 0 ? std::min(smallest, diagonal) : diagonal;
    }
  }
  if (smallest > 0) census.size_ratio = largest / smallest;
  return census;
}

std::string check_expectations(const Scene& scene, const Census& census) {
  const Expect& e = scene.expect;
  std::string difference;
  for_each_count(e, census, [&](const char* name, const std::optional<std::uint64_t>& expected, std::uint64_t built) {
    if (difference.empty() && expected && *expected != built)
      difference = fmt::format("{}: expected {} {}, built {}", scene.file, *expected, name, built);
  });
  if (!difference.empty()) return difference;
  if (e.size_ratio && census.size_ratio < *e.size_ratio)
    return fmt::format("{}: expected a size ratio of {} at least, built {}", scene.file, *e.size_ratio,
                       census.size_ratio);
  return {};
}

}  // namespace boxstream::scenes
