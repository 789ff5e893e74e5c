// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"
#include "engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

struct Reason {
  std::string operator()(const HingeJoint& joint) const { return joint.motor ? "a hinge with a motor" : ""; }
  std::string operator()(const SliderJoint& joint) const { return joint.motor ? "a slider with a motor" : ""; }
  template <class Other>
  std::string operator()(const Other&) const {
    return {};
  }
};

std::optional<Call> called_for(const Subject& subject) {
  return first_joint(subject, [](const Joint& joint) { return std::visit(Reason{}, joint.value); });
}

/// A motor that keeps nothing but speed 0 lets its joint creep, for a solver leaves some of it in each step. This much
/// of what a joint has crept is mended in a step, with no more force than the motor has.
constexpr double mended = 0.2;

struct Hold {
  Stage& stage;
  std::size_t joint;
  double dt;

  void operator()(const HingeJoint&) const {
    auto& hinge = static_cast<btHingeConstraint&>(*stage.joints[joint]);
    hinge.setMotorTargetVelocity(real(-mended / dt * double{hinge.getHingeAngle()}));
  }
  void operator()(const SliderJoint&) const {
    auto& slider = static_cast<btSliderConstraint&>(*stage.joints[joint]);
    // Bullet works the position out within a step, and before the first one it is not initialised.
    slider.calculateTransforms(slider.getRigidBodyA().getCenterOfMassTransform(),
                               slider.getRigidBodyB().getCenterOfMassTransform());
    slider.testLinLimits();
    slider.setTargetLinMotorVelocity(real(-mended / dt * double{slider.getLinearPos()}));
  }
  template <class Other>
  void operator()(const Other&) const {}
};

struct Holds {
  bool operator()(const HingeJoint& value) const { return value.motor && value.motor->speed == 0; }
  bool operator()(const SliderJoint& value) const { return value.motor && value.motor->speed == 0; }
  template <class Other>
  bool operator()(const Other&) const {
    return false;
  }
};

void start(Stage& stage) {
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < stage.expanded.joints.size(); ++i)
    if (std::visit(Holds{}, stage.expanded.joints[i].value)) held.push_back(i);
  if (held.empty()) return;
  stage.before_substep(motors, [&stage, held](double dt) {
    for (const std::size_t i : held) std::visit(Hold{stage, i, dt}, stage.expanded.joints[i].value);
  });
}

}  // namespace

const Effect motors{"motors",
                    "joints are driven, or held where they are",
                    "a row of each motor, which the joint itself makes; what crept of speed 0 is mended",
                    called_for,
                    nullptr,
                    nullptr,
                    start};

}  // namespace boxstream::effects
