// SPDX-License-Identifier: MIT
#include "simulation/engine/joints.hpp"
#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

// Joints, where they end, and what drives them.
namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_joints(const Subject& subject) {
  return first_joint(subject, [](const Joint&) { return "a joint"; });
}

void prepare_joints(const Subject& subject, WorldRecipe& recipe) {
  recipe.solver.m_erp = real(subject.scene.solver.erp);
}

void start_joints(SceneInstance& instance) {
  for (const Joint& joint : instance.expanded.joints) {
    btRigidBody* const b = joint.b ? instance.bodies[*joint.b].get() : nullptr;
    instance.joints.push_back(make_joint(joint.value, *instance.bodies[joint.a], b, instance.substep));
    btTypedConstraint& made = *instance.joints.back();
    if (!instance.subject.trees.has_joint(instance.joints.size() - 1)) {
      instance.world.world().addConstraint(&made, !joint.collide);
    } else if (!joint.collide) {
      made.getRigidBodyA().addConstraintRef(&made);
      made.getRigidBodyB().addConstraintRef(&made);
    }
  }
}

std::string limit_of(const ConeTwistJoint&) {
  return "a cone with limits";
}
std::string limit_of(const SixDofJoint& joint) {
  for (const auto& axes : {joint.linear, joint.angular})
    for (const auto& [low, high] : axes)
      if (low < high) return "an axis with limits";
  return {};
}
template <class Other>
std::string limit_of(const Other& joint) {
  if constexpr (requires { joint.limits; })
    if (joint.limits) return fmt::format("a {} with limits", Other::kind);
  return {};
}

/// None if it has none that acts.
std::optional<Motor> motor_of(const Joint& joint) {
  const auto of = [](const auto& value) -> std::optional<Motor> {
    if constexpr (requires { value.motor; })
      if (value.motor && value.motor->acts()) return value.motor;
    return std::nullopt;
  };
  return std::visit(of, joint.value);
}

std::optional<Call> calls_for_limits(const Subject& subject) {
  return first_joint(subject, [](const Joint& joint) {
    return std::visit([](const auto& value) { return limit_of(value); }, joint.value);
  });
}

std::optional<Call> calls_for_motors(const Subject& subject) {
  return first_joint(subject, [](const Joint& joint) {
    const auto kind = [](const auto& value) { return fmt::format("a {} with a motor", value.kind); };
    return motor_of(joint) ? std::visit(kind, joint.value) : "";
  });
}

/// A motor of speed 0 lets its joint creep, since a solver leaves some of the error in each step. This much
/// of what a joint has crept is mended in a step, with no more force than the motor has.
constexpr double mended = 0.2;

struct Hold {
  SceneInstance& instance;
  std::size_t joint;
  double dt;

  void operator()(const HingeJoint&) const {
    auto& hinge = static_cast<btHingeConstraint&>(*instance.joints[joint]);
    hinge.setMotorTargetVelocity(real(-mended / dt * double{hinge.getHingeAngle()}));
  }
  void operator()(const SliderJoint&) const {
    auto& slider = static_cast<btSliderConstraint&>(*instance.joints[joint]);
    // Bullet works the position out within a step, and before the first one it is not initialised.
    slider.calculateTransforms(slider.getRigidBodyA().getCenterOfMassTransform(),
                               slider.getRigidBodyB().getCenterOfMassTransform());
    slider.testLinLimits();
    slider.setTargetLinMotorVelocity(real(-mended / dt * double{slider.getLinearPos()}));
  }
  template <class Other>
  void operator()(const Other&) const {}
};

void start_motors(SceneInstance& instance) {
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < instance.expanded.joints.size(); ++i)
    if (const auto motor = motor_of(instance.expanded.joints[i]);
        motor && motor->speed == 0 && !instance.subject.trees.has_joint(i))
      held.push_back(i);
  if (held.empty()) return;
  instance.before_substep(motors, [&instance, held](double dt) {
    for (const std::size_t i : held) std::visit(Hold{instance, i, dt}, instance.expanded.joints[i].value);
  });
}

}  // namespace

const Effect joints{"joints",
                    "bodies are held together",
                    "a constraint for each, with rows in each iteration",
                    calls_for_joints,
                    {.prepare = prepare_joints, .start = start_joints},
                    {"rows", count_rows<&SolverRows::acting_joint>, Effect::Activity::of_run}};

const Effect joint_limits{"joint_limits",
                          "joints end somewhere",
                          "rows of joints that are at a limit, which the joint itself makes",
                          calls_for_limits,
                          {},
                          {"rows", count_rows<&SolverRows::acting_limit>, Effect::Activity::of_run}};

const Effect motors{"motors",
                    "joints are driven, or held where they are",
                    "a row of each motor, which the joint itself makes; what crept of speed 0 is mended",
                    calls_for_motors,
                    {.start = start_motors},
                    {"rows", count_rows<&SolverRows::acting_motor>, Effect::Activity::of_run}};

}  // namespace boxstream::effects
