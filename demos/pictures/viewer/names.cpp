// SPDX-License-Identifier: MIT
#include "pictures/viewer/names.hpp"

#include "formats/scene_model/expand.hpp"

namespace boxstream::view {

std::vector<std::string> names_of(const scenes::Scene& scene) {
  const scenes::Expanded expanded = scenes::expand(scene);
  std::vector<std::string> names;
  for (const scenes::Body& body : expanded.bodies)
    names.push_back(body.name.empty() ? expanded.shapes[body.traits.shape].name : body.name);
  for (const scenes::Sensor& sensor : scene.sensors) names.push_back(sensor.name);
  for (const scenes::Character& character : scene.characters) names.push_back(character.name);
  for (const scenes::SoftBody& soft : scene.soft_bodies) names.push_back(soft.name);
  return names;
}

}  // namespace boxstream::view
