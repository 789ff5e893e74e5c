// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "formats/scene_model/expand.hpp"
#include "witnesses/simbody_model.hpp"
#include "witnesses/weights.hpp"
#include "witnesses/witness.hpp"

namespace boxstream::witnesses {
namespace {

using scenes::BodyType;

struct MakeJoint {
  simbody::Joint& joint;

  void operator()(const scenes::BallJoint& from) const { set(simbody::JointKind::ball, from.pivot); }
  void operator()(const scenes::FixedJoint& from) const { set(simbody::JointKind::fixed, from.pivot); }
  void operator()(const scenes::HingeJoint& from) const {
    if (from.limits || from.motor) throw Unknown("a hinge with limits or a motor");
    set(simbody::JointKind::hinge, from.pivot);
    joint.axis = from.axis;
  }
  void operator()(const scenes::SliderJoint& from) const {
    if (from.limits || from.motor) throw Unknown("a slider with limits or a motor");
    set(simbody::JointKind::slider, from.pivot);
    joint.axis = from.axis;
  }
  void operator()(const scenes::SpringJoint& from) const {
    set(simbody::JointKind::spring, from.pivot);
    joint.stiffness = from.stiffness;
    joint.damping = from.damping;
  }
  template <class Other>
  void operator()(const Other&) const {
    throw Unknown(std::string("a joint of type ") + Other::kind);
  }

 private:
  void set(simbody::JointKind kind, const scenes::Vec3& pivot) const {
    joint.kind = kind;
    joint.pivot = pivot;
  }
};

simbody::Body body_of(const scenes::Expanded& expanded, const scenes::Body& from) {
  const Weight weight = weight_of(expanded, from);
  simbody::Body body;
  body.start = {from.position, from.rotation};
  body.mass = weight.mass;
  body.centre = weight.centre;
  body.inertia = {weight.inertia[0][0], weight.inertia[1][1], weight.inertia[2][2]};
  body.products = {weight.inertia[0][1], weight.inertia[0][2], weight.inertia[1][2]};
  body.velocity = from.velocity;
  body.spin = from.spin;
  return body;
}

}  // namespace

bool simbody_is_built() {
  return true;
}

std::vector<Frame> run_simbody(const scenes::Scene& scene, std::size_t steps, double accuracy) {
  const scenes::Expanded expanded = scenes::expand(scene);
  if (!scene.fields.empty() || !scene.soft_bodies.empty() || scene.world.tumbling)
    throw Unknown("fields or soft bodies");
  simbody::Model model;
  model.gravity = scene.world.gravity;
  std::vector<std::size_t> numbers, dynamic;  // what does not move is the world
  for (std::size_t i = 0; i < expanded.bodies.size(); ++i) {
    const scenes::Body& from = expanded.bodies[i];
    numbers.push_back(simbody::world);
    if (from.traits.type == BodyType::kinematic) throw Unknown("a kinematic body");
    if (from.traits.type == BodyType::fixed) continue;
    if (from.traits.linear_damping != 0 || from.traits.angular_damping != 0) throw Unknown("damping");
    numbers.back() = model.bodies.size();
    dynamic.push_back(i);
    model.bodies.push_back(body_of(expanded, from));
  }
  for (const scenes::Joint& from : expanded.joints) {
    simbody::Joint joint;
    std::visit(MakeJoint{joint}, from.value);
    joint.a = numbers[from.a];
    joint.b = from.b ? numbers[*from.b] : simbody::world;
    model.joints.push_back(joint);
  }
  std::vector<Frame> frames;
  try {
    for (const simbody::Frame& from : simbody::run(model, scene.time.dt, steps, accuracy)) {
      Frame& frame = frames.emplace_back();
      frame.energy = from.energy;
      for (std::size_t i = 0; i < dynamic.size(); ++i) {
        const simbody::Moving& m = from.bodies[i];
        frame.bodies.push_back({dynamic[i], m.pose.position, m.pose.rotation, m.velocity, m.spin});
      }
    }
  } catch (const std::invalid_argument& error) {
    throw Unknown(error.what());
  }
  return frames;
}

}  // namespace boxstream::witnesses
