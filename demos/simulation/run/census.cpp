// SPDX-License-Identifier: MIT
#include <algorithm>

#include <BulletSoftBody/btSoftBody.h>
#include <fmt/format.h>

#include "simulation/run/simulation_parts.hpp"

namespace boxstream::scenes {
namespace {

struct CountShape {
  Census& census;

  void operator()(const BoxShape&) const { ++census.boxes; }
  void operator()(const SphereShape&) const { ++census.spheres; }
  void operator()(const CapsuleShape&) const { ++census.capsules; }
  void operator()(const CylinderShape&) const { ++census.cylinders; }
  void operator()(const ConeShape&) const { ++census.cones; }
  void operator()(const HullShape&) const { ++census.hulls; }
  void operator()(const PlaneShape&) const { ++census.planes; }
  void operator()(const HeightfieldShape&) const { ++census.heightfields; }
  void operator()(const MeshShape&) const { ++census.meshes; }
  void operator()(const CompoundShape&) const { ++census.compounds; }
};

}  // namespace

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
    std::visit(CountShape{census}, instance.expanded.shapes[instance.expanded.bodies[i].traits.shape].value);
    if (body.isStaticObject()) {
      ++census.fixed;
    } else if (body.isKinematicObject()) {
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
  struct Row {
    const char* name;
    std::optional<std::uint64_t> expected;
    std::uint64_t built;
  };
  const Row rows[] = {{"objects", e.objects, census.objects},
                      {"bodies", e.bodies, census.bodies},
                      {"static", e.fixed, census.fixed},
                      {"kinematic", e.kinematic, census.kinematic},
                      {"dynamic", e.dynamic, census.dynamic},
                      {"joints", e.joints, census.joints},
                      {"sensors", e.sensors, census.sensors},
                      {"characters", e.characters, census.characters},
                      {"soft_bodies", e.soft_bodies, census.soft_bodies},
                      {"soft_nodes", e.soft_nodes, census.soft_nodes},
                      {"boxes", e.boxes, census.boxes},
                      {"spheres", e.spheres, census.spheres},
                      {"capsules", e.capsules, census.capsules},
                      {"cylinders", e.cylinders, census.cylinders},
                      {"cones", e.cones, census.cones},
                      {"hulls", e.hulls, census.hulls},
                      {"planes", e.planes, census.planes},
                      {"heightfields", e.heightfields, census.heightfields},
                      {"meshes", e.meshes, census.meshes},
                      {"compounds", e.compounds, census.compounds}};
  for (const Row& row : rows)
    if (row.expected && *row.expected != row.built)
      return fmt::format("{}: expected {} {}, built {}", scene.file, *row.expected, row.name, row.built);
  if (e.size_ratio && census.size_ratio < *e.size_ratio)
    return fmt::format("{}: expected a size ratio of {} at least, built {}", scene.file, *e.size_ratio,
                       census.size_ratio);
  return {};
}

}  // namespace boxstream::scenes
