// SPDX-License-Identifier: MIT
#include "settle.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <utility>

#include "formats/scene_model/expand.hpp"
#include "knob.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {

using scenes::Scene;

std::vector<Place> places_at_rest(Scene scene, const std::string& broadphase, std::uint64_t steps) {
  // A scene that is run for longer or shorter may call for other effects.
  scene.time.steps = static_cast<int>(steps);
  scenes::Simulation simulation(scene, broadphase);
  while (simulation.steps_done() < steps) simulation.advance();
  const double speed = simulation.metric(scenes::Check::Metric::max_speed);
  if (!(speed <= rest_speed))
    throw BadKnob("the scene does not come to rest in " + std::to_string(steps) + " steps: a body moves by " +
                  std::to_string(speed) + " m/s");
  std::vector<Place> places(scenes::expand(scene).bodies.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const btTransform at = simulation.pose(i);
    const btQuaternion turn = at.getRotation();
    places[i] = {{at.getOrigin().x(), at.getOrigin().y(), at.getOrigin().z()},
                 {turn.x(), turn.y(), turn.z(), turn.w()}};
  }
  return places;
}

Scene placed(const Scene& scene, const std::vector<Place>& places) {
  scenes::Expanded expanded = scenes::expand(scene);
  Scene at_rest = scene;
  at_rest.shapes = std::move(expanded.shapes);
  at_rest.bodies = std::move(expanded.bodies);
  at_rest.joints = std::move(expanded.joints);
  at_rest.exclusions = std::move(expanded.exclusions);
  at_rest.generators.clear();
  for (std::size_t i = 0; i < at_rest.bodies.size(); ++i) {
    scenes::Body& body = at_rest.bodies[i];
    if (body.traits.type != scenes::BodyType::dynamic) continue;
    body.position = places.at(i).position;
    body.rotation = places.at(i).rotation;
    body.velocity = body.spin = {};
  }
  return at_rest;
}

}  // namespace boxstream::accuracy
