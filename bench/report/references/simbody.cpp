// SPDX-License-Identifier: MIT
#include "references/simbody.hpp"

#include <cmath>
#include <numbers>

#include "format/experiment.hpp"
#include "formats/scene_model/expand.hpp"
#include "references/simbody_model.hpp"

namespace boxstream::report {
namespace {

using scenes::BodyType;
using scenes::Expanded;

[[noreturn]] void refuse(const scenes::Scene& scene, const std::string& reason) {
  throw BadExperiment(scene.file + ": no reference by Simbody: " + reason);
}

/// Masses and moments of inertia by the formulas of textbooks.
void weigh(const scenes::Scene& scene, const Expanded& expanded, const scenes::Body& from, simbody::Body& body) {
  const scenes::ShapeValue& shape = expanded.shapes[from.traits.shape].value;
  double volume = 0;
  simbody::Numbers3 squares{};  // of inertia over mass
  if (const auto* const box = std::get_if<scenes::BoxShape>(&shape)) {
    const auto& [x, y, z] = box->half_extents;
    volume = 8 * x * y * z;
    squares = {(y * y + z * z) / 3, (z * z + x * x) / 3, (x * x + y * y) / 3};
  } else if (const auto* const ball = std::get_if<scenes::SphereShape>(&shape)) {
    volume = 4 * std::numbers::pi / 3 * std::pow(ball->radius, 3);
    squares.fill(0.4 * ball->radius * ball->radius);
  } else {
    refuse(scene, "a shape that is neither box nor ball");
  }
  body.mass = from.traits.mass ? *from.traits.mass : *from.traits.density * volume;
  for (std::size_t axis = 0; axis < 3; ++axis) body.inertia[axis] = body.mass * squares[axis];
}

simbody::Joint joint_of(const scenes::Scene& scene, const scenes::Joint& from) {
  simbody::Joint joint;
  if (const auto* const ball = std::get_if<scenes::BallJoint>(&from.value)) {
    joint.pivot = ball->pivot;
    return joint;
  }
  const auto* const hinge = std::get_if<scenes::HingeJoint>(&from.value);
  if (hinge == nullptr || hinge->limits || hinge->motor)
    refuse(scene, "a joint that is neither a ball joint nor a free hinge");
  joint.pivot = hinge->pivot;
  joint.hinge = true;
  joint.axis = hinge->axis;
  return joint;
}

simbody::Model model_of(const scenes::Scene& scene) {
  const Expanded expanded = scenes::expand(scene);
  simbody::Model model;
  model.gravity = scene.world.gravity;
  std::vector<std::size_t> numbers;  // what does not move is the world
  std::vector<bool> joined(expanded.bodies.size());
  for (const scenes::Joint& joint : expanded.joints) {
    joined[joint.a] = true;
    if (joint.b) joined[*joint.b] = true;
  }
  for (std::size_t i = 0; i < expanded.bodies.size(); ++i) {
    const scenes::Body& from = expanded.bodies[i];
    numbers.push_back(simbody::world);
    if (from.traits.type == BodyType::kinematic) refuse(scene, "a kinematic body");
    if (from.traits.type == BodyType::fixed) continue;
    if (joined[i] && (from.velocity != scenes::Vec3{} || from.spin != scenes::Vec3{}))
      refuse(scene, "a joined body in motion");
    numbers.back() = model.bodies.size();
    simbody::Body body;
    body.start = {from.position, from.rotation};
    body.velocity = from.velocity;
    body.spin = from.spin;
    weigh(scene, expanded, from, body);
    model.bodies.push_back(body);
  }
  for (const scenes::Joint& from : expanded.joints) {
    simbody::Joint joint = joint_of(scene, from);
    joint.a = numbers[from.a];
    joint.b = from.b ? numbers[*from.b] : simbody::world;
    model.joints.push_back(joint);
  }
  return model;
}

}  // namespace

bool simbody_is_built() {
  return true;
}

accuracy::Trajectory simbody_trajectory(const scenes::Scene& scene, std::uint64_t steps) {
  const auto number = [](double value) { return static_cast<btScalar>(value); };
  accuracy::Trajectory trajectory;
  for (const std::vector<simbody::Pose>& poses : simbody::run(model_of(scene), scene.time.dt, steps)) {
    accuracy::Frame& frame = trajectory.frames.emplace_back();
    for (const auto& [p, q] : poses) {
      frame.positions.emplace_back(number(p[0]), number(p[1]), number(p[2]));
      frame.rotations.emplace_back(number(q[0]), number(q[1]), number(q[2]), number(q[3]));
    }
  }
  return trajectory;
}

}  // namespace boxstream::report
