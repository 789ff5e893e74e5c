// SPDX-License-Identifier: MIT
#include "simulation/effects/unfit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <variant>

#include <boxstream/function_ref.hpp>

#include "formats/geometry/frame.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/shape_size.hpp"
#include "simulation/effects/tunnelling.hpp"
#include "simulation/engine/bullet_shapes.hpp"
#include "simulation/engine/mass.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

/// The body of which `worth(body)` is largest, if that is above 1.
template <class Worth>
std::optional<std::size_t> worst(const Subject& subject, Worth worth) {
  std::optional<std::size_t> found;
  double most = 1;
  for (std::size_t i = 0; i < subject.expanded.bodies.size(); ++i)
    if (const double w = worth(subject.expanded.bodies[i]); w > most) most = w, found = i;
  return found;
}

std::string name_of(const Subject& subject, std::size_t body) {
  const std::string& name = subject.expanded.bodies[body].name;
  return name.empty() ? fmt::format("body {}", body) : fmt::format("body {} (\"{}\")", body, name);
}

/// By how much a joint is out of its limits where it starts, which is at 0; 0: it is within them, or is free.
double beyond(const std::array<double, 2>& limits) {
  return limits[0] > limits[1] ? 0 : std::max({0.0, limits[0], -limits[1]});
}

struct Disagreement {
  double length = 0, angle = 0;  // metres, radians
};

Disagreement disagreement(const JointValue& joint) {
  if (const auto* const hinge = std::get_if<HingeJoint>(&joint)) return {0, hinge->limits ? beyond(*hinge->limits) : 0};
  if (const auto* const slider = std::get_if<SliderJoint>(&joint))
    return {slider->limits ? beyond(*slider->limits) : 0, 0};
  Disagreement most;
  if (const auto* const free = std::get_if<SixDofJoint>(&joint))
    for (std::size_t d = 0; d < 3; ++d)
      most = {std::max(most.length, beyond(free->linear[d])), std::max(most.angle, beyond(free->angular[d]))};
  return most;
}

/// Joints whose bodies start where the joints do not allow them to be.
void find_disagreements(const Subject& subject, std::vector<std::string>& lines) {
  std::size_t count = 0, first = 0;
  const std::vector<Joint>& joints = subject.expanded.joints;
  for (std::size_t i = joints.size(); i-- > 0;) {
    const Disagreement off = disagreement(joints[i].value);
    if (off.length <= 0 && off.angle <= 0) continue;
    ++count;
    first = i;
  }
  if (count == 0) return;
  const Disagreement off = disagreement(joints[first].value);
  const std::string kind = std::visit([](const auto& value) { return std::string(value.kind); }, joints[first].value);
  lines.push_back(
      fmt::format("joint {} (a {} of {}) starts {} out of its limits{}: it is pulled there from the first step "
                  "on, and gains speed by it; place its bodies within them",
                  first, kind, name_of(subject, joints[first].a),
                  off.angle > 0 ? fmt::format("{:.3g} degrees", off.angle * 180 / std::numbers::pi)
                                : fmt::format("{:.3g} m", off.length),
                  count > 1 ? fmt::format(", as do {} others", count - 1) : ""));
}

constexpr double rest_time = 2, slow = 0.8, slow_spin = 1;  // s, m/s and rad/s: Bullet puts to rest what is slower

double length(const Vec3& v) {
  return std::sqrt(geometry::dot(v, v));
}

/// The most that a body comes to, in m/s and rad/s.
struct Haste {
  double speed = 0, spin = 0;
};

/// What joints do to a body.
struct Held {
  std::size_t joints = 0;
  const Joint* last = nullptr;
  bool is_driven = false;  // by a spring or a motor, and so never put to rest
};

std::vector<Held> held_by_joints(const Subject& subject) {
  std::vector<Held> held(subject.expanded.bodies.size());
  for (const Joint& joint : subject.expanded.joints)
    for (const std::optional<std::size_t> body : {std::optional(joint.a), joint.b}) {
      if (!body) continue;
      Held& of = held[*body];
      ++of.joints;
      of.last = &joint;
      of.is_driven = of.is_driven || drives(joint);
    }
  return held;
}

/// Whether a body swings about a point that stands still.
bool is_pendulum(const Subject& subject, std::size_t body, const Held& held) {
  if (held.joints != 1 || held.last->a != body) return false;
  const auto* const hinge = std::get_if<HingeJoint>(&held.last->value);
  const bool swings = std::holds_alternative<BallJoint>(held.last->value) || (hinge != nullptr && !hinge->motor);
  return swings && (!held.last->b || !is_dynamic(subject.expanded.bodies[*held.last->b]));
}

/// At the lowest point of its way.
Haste haste_of_pendulum(const Body& body, const Vec3& centre, const Joint& joint, Vec3 gravity) {
  const auto* const hinge = std::get_if<HingeJoint>(&joint.value);
  Vec3 arm = geometry::minus(centre, hinge != nullptr ? hinge->pivot : std::get<BallJoint>(joint.value).pivot);
  if (hinge != nullptr)
    for (Vec3* const v : {&arm, &gravity})
      *v = geometry::minus(*v, geometry::times(hinge->axis, geometry::dot(*v, hinge->axis)));
  const double radius = length(arm), fall = length(gravity) * radius - geometry::dot(gravity, arm);
  const double start = std::max(length(body.velocity), length(geometry::cross(body.spin, arm)));
  const double speed = std::sqrt(start * start + 2 * std::max(0.0, fall));
  return {speed, std::max(length(body.spin), radius > 0 ? speed / radius : 0)};
}

/// Where drag takes as much as gravity gives.
double terminal_speed(const DragField& drag, double weight) {
  if (drag.quadratic == 0) return drag.linear > 0 ? weight / drag.linear : std::numeric_limits<double>::infinity();
  return (std::sqrt(drag.linear * drag.linear + 4 * drag.quadratic * weight) - drag.linear) / (2 * drag.quadratic);
}

/// Of what flies, swings or sinks and meets nothing; none where more acts on it.
std::optional<Haste> haste_of(const Subject& subject, std::size_t index, const Held& held, FunctionRef<Mass()> mass) {
  const Scene& scene = subject.scene;
  const Body& body = subject.expanded.bodies[index];
  const double gravity = strength_of_gravity(scene.world);
  if (held.is_driven || scene.world.tumbling) return std::nullopt;
  if (gravity == 0 && scene.fields.empty()) return Haste{length(body.velocity), length(body.spin)};
  if (scene.fields.empty() && is_pendulum(subject, index, held))
    return haste_of_pendulum(body, geometry::Frame{body.position, body.rotation}.place(mass().frame.origin), *held.last,
                             scene.world.gravity);
  if (gravity == 0 || held.joints > 0) return std::nullopt;
  if (scene.fields.empty()) return Haste{length(body.velocity) + gravity * rest_time, length(body.spin)};
  const auto* const drag = std::get_if<DragField>(&scene.fields.front());
  if (drag == nullptr || drag->density > 0 || scene.fields.size() > 1 || has_contacts(subject)) return std::nullopt;
  return Haste{terminal_speed(*drag, mass().mass * gravity), 0};
}

/// What moves slowly though nothing has brought it to rest, and would move on, is put to rest by Bullet.
void find_drowsy(const Subject& subject, std::vector<std::string>& lines) {
  constexpr double still = 1e-3;  // of the limits
  const Scene& scene = subject.scene;
  const std::vector<Body>& bodies = subject.expanded.bodies;
  if (scene.time.dt * (scene.time.steps + scene.time.warmup_steps) <= rest_time) return;
  const bool all_fall = scene.fields.empty() && subject.expanded.joints.empty();
  if (all_fall && strength_of_gravity(scene.world) * rest_time >= slow) return;
  const std::vector<Held> held = held_by_joints(subject);
  std::optional<ShapeSet> shapes;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const BodyTraits& traits = bodies[i].traits;
    if (!is_dynamic(bodies[i]) || !traits.sleep) continue;
    const ShapeSize size = size_of(subject.expanded.shapes, traits.shape);
    const auto mass = [&] {
      if (!shapes) shapes.emplace(subject.expanded.shapes);
      return mass_of(bodies[i], shapes->solid(traits.shape));
    };
    const std::optional<Haste> haste = haste_of(subject, i, held[i], mass);
    const double speed = haste ? haste->speed / (slow * (size.is_small() ? size.largest : 1)) : 0;
    const double spin = haste ? haste->spin / slow_spin : 0;
    if (std::max(speed, spin) < still || std::max(speed, spin) >= 1) continue;
    lines.push_back(fmt::format(
        "{} comes to {:.2g} m/s and {:.2g} rad/s at most, which is slow enough to be put to rest after {} s; "
        "\"sleep\": false of the body lets it go on",
        name_of(subject, i), haste->speed, haste->spin, rest_time));
    return;
  }
}

/// Gravity that turns slowly lets bodies lie, and fall asleep: they hang then where it pulls them off.
void find_asleep_in_tumbling(const Subject& subject, std::vector<std::string>& lines) {
  constexpr double slope = 45;  // degrees at which few things still lie
  const Scene& scene = subject.scene;
  if (!scene.world.tumbling || scene.world.tumbling->degrees_per_second * rest_time >= slope ||
      scene.time.dt * (scene.time.steps + scene.time.warmup_steps) <= rest_time || !has_contacts(subject))
    return;
  const auto& bodies = subject.expanded.bodies;
  const auto may_sleep = [](const Body& body) { return is_dynamic(body) && body.traits.sleep; };
  const auto first = std::find_if(bodies.begin(), bodies.end(), may_sleep);
  if (first == bodies.end()) return;
  lines.push_back(fmt::format(
      "{} may be put to rest where it lies for {} s, and gravity, which turns, does not wake it; \"sleep\": false of "
      "the body lets it fall",
      name_of(subject, static_cast<std::size_t>(first - bodies.begin())), rest_time));
}

}  // namespace

std::vector<std::string> unfit(const Subject& subject) {
  std::vector<std::string> lines = not_by_multibodies(subject);
  find_disagreements(subject, lines);
  find_drowsy(subject, lines);
  find_asleep_in_tumbling(subject, lines);
  if (!has_contacts(subject)) return lines;
  const Scene& scene = subject.scene;
  const double substep = scene.time.dt / scene.time.substeps,
               fall = strength_of_gravity(scene.world) * substep * substep;
  const auto size = [&](const Body& body) {
    return is_dynamic(body) ? size_of(subject.expanded.shapes, body.traits.shape).largest : 0;
  };
  const auto falls_far = [&](const Body& body) { return size(body) > 0 ? 2 * fall / size(body) : 0; };
  const auto enough = [&](double extent) {
    return fmt::format("take {:.0f} substeps or more",
                       std::ceil(scene.time.dt / std::sqrt(extent / 8 / strength_of_gravity(scene.world))));
  };
  if (const auto i = worst(subject, falls_far)) {
    const double extent = size(subject.expanded.bodies[*i]);
    lines.push_back(
        fmt::format("{} is {:.2g} m large and falls {:.2g} m in a step from rest: what it hits, it is deep in or "
                    "beyond; {}",
                    name_of(subject, *i), extent, fall, enough(extent)));
    return lines;
  }
  const std::vector<double> half = half_thicknesses(subject.expanded.shapes);
  const auto thickness = [&](const Body& body) { return is_dynamic(body) ? 2 * half[body.traits.shape] : 0; };
  const auto falls_through = [&](const Body& body) { return thickness(body) > 0 ? 2 * fall / thickness(body) : 0; };
  if (const auto i = worst(subject, falls_through)) {
    const double extent = thickness(subject.expanded.bodies[*i]);
    lines.push_back(
        fmt::format("{} is {:.2g} m thick and falls {:.2g} m in a step from rest: where it lies, it sinks in; {}",
                    name_of(subject, *i), extent, fall, enough(extent)));
  }
  return lines;
}

std::vector<std::string> unfit(const Scene& scene) {
  const Expanded expanded = expand(scene);
  return unfit(Subject{scene, expanded});
}

}  // namespace boxstream::effects
