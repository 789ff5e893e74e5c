// SPDX-License-Identifier: MIT
#include "simulation/effects/unfit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

#include "simulation/effects/find.hpp"
#include "simulation/effects/shape_size.hpp"
#include "simulation/effects/tunnelling.hpp"

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

/// What flies slowly where nothing pulls at it, and would fly on, is put to rest by Bullet.
void find_drowsy(const Subject& subject, std::vector<std::string>& lines) {
  constexpr double rest_time = 2, slow = 0.8, slow_spin = 1;  // s, m/s and rad/s: Bullet's
  const Scene& scene = subject.scene;
  if (strength_of_gravity(scene.world) > 0 || !scene.fields.empty() || scene.time.dt * scene.time.steps <= rest_time)
    return;
  const auto length = [](const Vec3& v) { return std::hypot(v[0], v[1], v[2]); };
  for (std::size_t i = 0; i < subject.expanded.bodies.size(); ++i) {
    const Body& body = subject.expanded.bodies[i];
    const double speed = length(body.velocity), spin = length(body.spin);
    const ShapeSize size = size_of(subject.expanded.shapes, body.traits.shape);
    if (!is_dynamic(body) || !body.traits.sleep || speed + spin == 0 || spin >= slow_spin ||
        speed >= slow * (size.is_small() ? size.largest : 1))
      continue;
    lines.push_back(
        fmt::format("{} moves at {:.2g} m/s and {:.2g} rad/s, which is slow enough to be put to rest after {} s; "
                    "\"sleep\": false of the body lets it go on",
                    name_of(subject, i), speed, spin, rest_time));
    return;
  }
}

}  // namespace

std::vector<std::string> unfit(const Subject& subject) {
  std::vector<std::string> lines = not_by_multibodies(subject);
  find_disagreements(subject, lines);
  find_drowsy(subject, lines);
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
