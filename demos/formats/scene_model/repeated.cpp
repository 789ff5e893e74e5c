// SPDX-License-Identifier: MIT
#include "formats/scene_model/repeated.hpp"

#include <cmath>
#include <variant>
#include <vector>

namespace boxstream::scenes {
namespace {

struct Move {
  double x, z;

  void operator()(Vec3& place) const {
    place[0] += x;
    place[2] += z;
  }
  void operator()(Bounds& bounds) const {
    (*this)(bounds.min);
    (*this)(bounds.max);
  }
  void operator()(RayFan& fan) const { (*this)(fan.from); }
  void operator()(BoxQuery& query) const { (*this)(query.bounds); }
  void operator()(ContactQuery&) const {}
  void operator()(ClothSoft& cloth) const {
    for (Vec3& corner : cloth.corners) (*this)(corner);
  }
  void operator()(BallSoft& ball) const { (*this)(ball.centre); }
};

bool is_plane(const Scene& scene, const Body& body) {
  return std::holds_alternative<PlaneShape>(scene.shapes[body.traits.shape].value);
}

/// Adds one copy of what `scene` has to `out`. `number[i]` is what became of body i in the copy before.
void add_copy(const Scene& scene, const Move& move, std::vector<std::size_t>& number, Scene& out) {
  const bool first = out.bodies.empty();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    if (!first && is_plane(scene, scene.bodies[i])) continue;
    number[i] = out.bodies.size();
    out.bodies.push_back(scene.bodies[i]);
    move(out.bodies.back().position);
  }
  for (Joint joint : scene.joints) {
    joint.a = number[joint.a];
    if (joint.b) joint.b = number[*joint.b];
    std::visit([&](auto& value) { move(value.pivot); }, joint.value);
    out.joints.push_back(std::move(joint));
  }
  for (Sensor sensor : scene.sensors) {
    move(sensor.position);
    out.sensors.push_back(std::move(sensor));
  }
  for (Character character : scene.characters) {
    for (Vec3& place : character.path) move(place);
    out.characters.push_back(std::move(character));
  }
  for (SoftBody soft : scene.soft_bodies) {
    std::visit(move, soft.value);
    out.soft_bodies.push_back(std::move(soft));
  }
  for (Vehicle vehicle : scene.vehicles) {
    vehicle.chassis = number[vehicle.chassis];
    out.vehicles.push_back(std::move(vehicle));
  }
  for (Query query : scene.queries) {
    std::visit(move, query);
    if (auto* const contact = std::get_if<ContactQuery>(&query)) contact->body = number[contact->body];
    out.queries.push_back(query);
  }
  for (const auto& [a, b] : scene.exclusions) out.exclusions.push_back({number[a], number[b]});
}

}  // namespace

Scene repeated(const Scene& scene, int copies, double pitch) {
  Scene out = scene;
  out.expect = {};
  out.bodies.clear();
  out.joints.clear();
  out.sensors.clear();
  out.characters.clear();
  out.soft_bodies.clear();
  out.vehicles.clear();
  out.queries.clear();
  out.exclusions.clear();
  const int side = static_cast<int>(std::ceil(std::sqrt(copies)));
  std::vector<std::size_t> number(scene.bodies.size());
  for (int i = 0; i < copies; ++i) add_copy(scene, {i % side * pitch, i / side * pitch}, number, out);
  out.world.bounds.max[0] += side * pitch;
  out.world.bounds.max[2] += side * pitch;
  return out;
}

}  // namespace boxstream::scenes
