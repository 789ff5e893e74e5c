// SPDX-License-Identifier: MIT
#include "pictures/viewer/names.hpp"

#include "formats/scene_model/expand.hpp"

namespace boxstream::view {
namespace {

/// Of an object that is no rigid body: sensors come first, then characters, then soft bodies.
const std::string& name_of(const scenes::Scene& scene, std::size_t i) {
  if (i < scene.sensors.size()) return scene.sensors[i].name;
  i -= scene.sensors.size();
  return i < scene.characters.size() ? scene.characters[i].name : scene.soft_bodies[i - scene.characters.size()].name;
}

}  // namespace

std::vector<std::string> names_of(const scenes::Simulation& simulation, const Kept& kept) {
  const scenes::Expanded& expanded = simulation.expanded();
  std::vector<std::string> names;
  for (const std::uint32_t object : kept.objects) {
    if (object >= expanded.bodies.size()) {
      names.push_back(name_of(simulation.scene(), object - expanded.bodies.size()));
      continue;
    }
    const scenes::Body& body = expanded.bodies[object];
    names.push_back(body.name.empty() ? expanded.shapes[body.traits.shape].name : body.name);
  }
  return names;
}

}  // namespace boxstream::view
