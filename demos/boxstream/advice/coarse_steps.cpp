// SPDX-License-Identifier: MIT
#include "boxstream/advice/coarse_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <variant>
#include <vector>

#include "boxstream/advice/columns.hpp"
#include "boxstream/advice/reaching.hpp"
#include "formats/geometry/frame.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/shape_size.hpp"
#include "simulation/effects/tunnelling.hpp"

namespace boxstream::tool {
namespace {

using effects::is_dynamic;
using effects::Subject;
using geometry::dot;
using scenes::Body;

double size_of(const scenes::Vec3& v) {
  return std::sqrt(dot(v, v));
}

/// A scene as these questions need it.
struct Given {
  explicit Given(const Subject& whole)
      : subject(whole),
        bodies(whole.expanded.bodies),
        masses(masses_of(whole)),
        centres(centres_of(whole)),
        gravity(effects::strength_of_gravity(whole.scene.world)),
        step(whole.scene.time.dt / whole.scene.time.substeps),
        substeps(whole.scene.time.substeps) {}

  /// So many times as many substeps as there are, as advice.
  std::string finer(double times) const {
    return fmt::format("{:.0f} substeps get it right within a hundredth", std::ceil(substeps * times));
  }
  bool moves(std::size_t body) const { return is_dynamic(bodies[body]) && masses[body] > 0; }
  /// By rows of the solver, and not as a part of a multibody, which keeps its energy.
  bool moves_by_rows(std::size_t body) const { return moves(body) && !subject.trees.has_body(body); }

  const Subject& subject;
  const std::vector<Body>& bodies;
  std::vector<double> masses;
  std::vector<scenes::Vec3> centres;
  double gravity, step;
  int substeps;
};

using Found = std::optional<CoarseStep>;

Found loop(const Given& given);

/// What of it lies across a hinge's axis, of length one: the rest turns nothing.
scenes::Vec3 across(const scenes::Vec3& v, const scenes::Vec3& axis) {
  return geometry::minus(v, geometry::times(axis, geometry::dot(v, axis)));
}

/// From a hinge to the centre of mass of a body, across the axis.
scenes::Vec3 arm_of(const scenes::Vec3& centre, const scenes::HingeJoint& hinge) {
  const scenes::Vec3 whole = geometry::minus(centre, hinge.pivot), arm = across(whole, hinge.axis);
  return size_of(arm) > 1e-9 * size_of(whole) ? arm : scenes::Vec3{};  // or none, but for rounding
}

Found swing(const Given& given) {
  constexpr double fine = 75;  // steps in the time in which a pendulum turns by one radian
  std::vector<int> joints(given.bodies.size());
  for (const scenes::Joint& joint : given.subject.expanded.joints) {
    ++joints[joint.a];
    if (joint.b) ++joints[*joint.b];
  }
  for (const scenes::Joint& joint : given.subject.expanded.joints) {
    const auto* const ball = std::get_if<scenes::BallJoint>(&joint.value);
    const auto* const hinge = std::get_if<scenes::HingeJoint>(&joint.value);
    const bool held = !joint.b || !given.moves(*joint.b);
    if ((ball == nullptr && (hinge == nullptr || hinge->motor)) || !held || !given.moves_by_rows(joint.a)) continue;
    // What else hangs on it may hang from it, by a hinge, or lead round to the world.
    const bool carries = joints[joint.a] == 2 && hinge != nullptr && !loop(given);
    if (joints[joint.a] != 1 && !carries) continue;
    const Body& body = given.bodies[joint.a];
    const scenes::Vec3& centre = given.centres[joint.a];
    const scenes::Vec3 arm = hinge != nullptr ? arm_of(centre, *hinge) : geometry::minus(centre, ball->pivot);
    const double length = size_of(arm), speed = size_of(body.velocity);
    if (length == 0) continue;
    const scenes::Vec3& pull = given.subject.scene.world.gravity;
    const scenes::Vec3 g = hinge != nullptr ? across(pull, hinge->axis) : pull;
    const double level = given.gravity == 0 ? 1 : size_of(geometry::cross(arm, g)) / length / given.gravity;
    if (speed == 0 && (given.gravity == 0 || level < 0.1)) continue;
    const double rate = std::max(std::sqrt(given.gravity * level / length), speed / length);
    if (rate * given.step * fine <= 1) continue;
    return CoarseStep{
        fmt::format("a body swings {:.3g} m from a joint, in steps of {:.3g} s: it slows down and rises less "
                    "each time",
                    length, given.step),
        "4 substeps with \"solver\": {\"kind\": \"dantzig\"} keep 99 % of the height of a pendulum of 1 m "
        "for 20 s",
        "pendulum_height"};
  }
  return std::nullopt;
}

/// What hangs in a hinge of the world turns about that and precesses about nothing.
std::vector<bool> with_fixed_axis(const Given& given) {
  std::vector<bool> fixed(given.bodies.size());
  for (const scenes::Joint& joint : given.subject.expanded.joints)
    if (std::holds_alternative<scenes::HingeJoint>(joint.value) && !(joint.b && given.moves(*joint.b)))
      fixed[joint.a] = true;
  return fixed;
}

/// What turns freely is right (effects/gyroscopic); what a joint holds is turned by Bullet.
Found spin_on_a_joint(const Given& given) {
  constexpr double fine = 0.02;  // radians a step
  const std::vector<bool> fixed = with_fixed_axis(given);
  for (const scenes::Joint& joint : given.subject.expanded.joints)
    for (const std::optional<std::size_t> i : {std::optional(joint.a), joint.b}) {
      if (!i || !given.moves_by_rows(*i) || fixed[*i]) continue;
      const Body& body = given.bodies[*i];
      const double turn = size_of(body.spin) * given.step;
      const bool is_ball =
          std::holds_alternative<scenes::SphereShape>(given.subject.expanded.shapes[body.traits.shape].value);
      if (turn <= fine || body.traits.gyro == scenes::Gyro::off || (is_ball && !body.inertia)) continue;
      return CoarseStep{
          fmt::format("a body on a joint spins by {:.2g} degrees a step: it sinks and nods as it precesses",
                      turn * 180 / std::numbers::pi),
          "Twice as many substeps halve that", "gyroscope_level"};
    }
  return std::nullopt;
}

/// Hinges and sliders that close a loop, as cranks and linkages do. Two bodies on two hinges, as doors are, are none.
Found loop(const Given& given) {
  constexpr double fine = 0.004;  // radians a step
  const std::size_t world = given.bodies.size();
  const auto end = [&](std::optional<std::size_t> i) { return i && given.moves(*i) ? *i : world; };
  std::vector<std::size_t> leads(world + 1);
  for (std::size_t i = 0; i <= world; ++i) leads[i] = i;
  const auto root = [&](std::size_t i) {
    while (leads[i] != i) i = leads[i] = leads[leads[i]];
    return i;
  };
  bool is_closed = false;
  double rate = 0;
  std::set<std::array<std::size_t, 2>> joined;
  for (const scenes::Joint& joint : given.subject.expanded.joints) {
    const auto* const hinge = std::get_if<scenes::HingeJoint>(&joint.value);
    if (hinge == nullptr && !std::holds_alternative<scenes::SliderJoint>(joint.value)) continue;
    const std::size_t of_a = end(joint.a), of_b = end(joint.b), low = std::min(of_a, of_b), high = std::max(of_a, of_b);
    if (low == high || !joined.insert({low, high}).second) continue;
    const std::size_t a = root(low), b = root(high);
    is_closed = is_closed || a == b;
    leads[a] = b;
    if (hinge == nullptr) continue;
    for (const std::size_t i : {low, high}) {
      if (i == world) continue;
      const double arm = size_of(arm_of(given.centres[i], *hinge));
      rate = std::max({rate, size_of(given.bodies[i].spin), arm > 0 ? std::sqrt(given.gravity / arm) : 0});
    }
  }
  if (!is_closed || rate * given.step <= fine) return std::nullopt;
  return CoarseStep{
      fmt::format(
          "joints close a loop that turns by some {:.2g} degrees in a step: it slows down, and may come to rest",
          rate * given.step * 180 / std::numbers::pi),
      fmt::format("{:.0f} substeps keep it right for some seconds",
                  std::ceil(given.substeps * rate * given.step / fine)),
      "slider_crank", "witnesses"};
}

Found bounce(const Given& given) {
  if (given.subject.scene.solver.bounces == scenes::Bounces::on_contact) return std::nullopt;
  const auto bounces = [](const Body& body) { return body.traits.material.restitution > 0.24; };
  if (!given.subject.collidable.first(bounces, bounces)) return std::nullopt;
  return CoarseStep{
      "bodies bounce: they part faster or slower than the restitution says, or stop, and a row that is hit moves as "
      "one",
      "\"solver\": {\"bounces\": \"on_contact\"} gets it right within a hundredth", "bounce_0.5"};
}

/// Of what gravity alone slows down: damping and fields leave no height to compare with.
Found thrown(const Given& given) {
  const scenes::Scene& scene = given.subject.scene;
  if (given.gravity == 0 || scene.world.tumbling || !scene.fields.empty()) return std::nullopt;
  const scenes::Vec3& g = scene.world.gravity;
  const std::vector<double> half = effects::half_thicknesses(given.subject.expanded.shapes);
  std::vector<bool> joined(given.bodies.size());
  for (const scenes::Joint& joint : given.subject.expanded.joints) {
    joined[joint.a] = true;
    if (joint.b) joined[*joint.b] = true;
  }
  for (std::size_t i = 0; i < given.bodies.size(); ++i) {
    if (joined[i] || given.bodies[i].traits.linear_damping > 0) continue;
    const double up = -dot(g, given.bodies[i].velocity) / given.gravity;
    const double share = up > 0 ? given.gravity * given.step / up : 0;
    // What rises by less than it is thick hops, and is not thrown.
    const bool hops = up * up < 2 * given.gravity * half[given.bodies[i].traits.shape];
    if (!given.moves_by_rows(i) || share <= 0.01 || share > 1 || hops) continue;
    return CoarseStep{
        fmt::format("a body is thrown up at {:.3g} m/s: it rises {:.2g} % less high, by half of what it moves in "
                    "a step",
                    up, 100 * share),
        given.finer(share / 0.01), "apex"};
  }
  return std::nullopt;
}

Found drag(const Given& given) {
  for (const scenes::Field& field : given.subject.scene.fields)
    if (const auto* const oil = std::get_if<scenes::DragField>(&field))
      for (std::size_t i = 0; i < given.bodies.size(); ++i) {
        if (!given.moves(i)) continue;
        const double speed = size_of(given.bodies[i].velocity);
        const double share = speed * (oil->linear + oil->quadratic * speed) / given.masses[i] * given.step;
        if (speed == 0 || share / speed <= 0.01) continue;
        return CoarseStep{
            fmt::format("drag takes {:.2g} % of a body's speed in a step: it slows down too fast", 100 * share / speed),
            given.finer(share / speed / 0.005), "drag_decay"};
      }
  return std::nullopt;
}

/// Whether one of its own axes is along none of the world's.
bool is_tilted(const Body& body) {
  constexpr double least = 0.017;  // a degree
  const auto& [x, y, z, w] = body.rotation;
  const double turned[3] = {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)};
  for (const double along : turned)
    if (std::abs(along) > least && std::abs(along) < std::cos(least)) return true;
  return false;
}

Found slide(const Given& given) {
  const auto is_rough = [](const Body& body) { return body.traits.material.friction > 0; };
  const auto is_rough_and_moves = [&](const Body& body) { return is_rough(body) && is_dynamic(body); };
  const std::optional<std::size_t> first = given.subject.collidable.first(is_rough_and_moves, is_rough);
  if (!first || given.gravity == 0 || given.substeps >= 4) return std::nullopt;
  const scenes::Vec3& g = given.subject.scene.world.gravity;
  const bool slope = !given.subject.scene.world.tumbling && std::none_of(g.begin(), g.end(), [&](double along) {
    return std::abs(along) > given.gravity * 0.9999;
  });
  const bool belt = std::any_of(given.bodies.begin(), given.bodies.end(),
                                [](const Body& body) { return body.surface_velocity != scenes::Vec3{}; });
  // What friction brings to rest is off by half of what it moves in a step.
  double roughest = 0;
  for (const Body& body : given.bodies) roughest = std::max(roughest, body.traits.material.friction);
  const bool pushed = std::any_of(given.bodies.begin(), given.bodies.end(), [&](const Body& body) {
    const double speed = size_of(body.velocity), friction = body.traits.material.friction * roughest;
    return is_rough_and_moves(body) && speed > 0 && friction * given.gravity * given.step / speed > 0.01;
  });
  const bool ramp = std::any_of(given.bodies.begin(), given.bodies.end(), [&](const Body& body) {
    return is_rough(body) && !is_dynamic(body) && is_tilted(body);
  });
  if (!slope && !belt && !pushed && !ramp) return std::nullopt;
  return CoarseStep{
      "bodies slide or roll by friction: their ways are off by some hundredths, and by more where friction nearly "
      "holds "
      "them",
      "8 substeps, or \"solver\": {\"kind\": \"dantzig\"} close to the angle at which they stick, get them right",
      "slides"};
}

/// Boxes that stand on an edge: with something to lean on they may slip, without they rock or fall over.
Found leaning(const Given& given) {
  constexpr std::size_t few = 50;
  if (given.gravity == 0 || given.bodies.size() > few) return std::nullopt;
  const Reaching reaching(given.subject);
  for (std::size_t i = 0; i < given.bodies.size(); ++i) {
    const Body& body = given.bodies[i];
    const scenes::ShapeValue& shape = given.subject.expanded.shapes[body.traits.shape].value;
    if (!given.moves(i) || !std::holds_alternative<scenes::BoxShape>(shape) || size_of(body.velocity) > 0 ||
        size_of(body.spin) > 0 || body.traits.material.friction == 0 || !is_tilted(body))
      continue;
    std::size_t touched = 0, rough = 0, level = 0;
    for (std::size_t other = 0; other < given.bodies.size(); ++other) {
      if (!given.subject.collidable.can_touch(i, other) || !reaching.touch(i, other)) continue;
      ++touched;
      const bool is_rough = given.bodies[other].traits.material.friction > 0;
      rough += is_rough ? 1 : 0;
      level += is_rough && !is_tilted(given.bodies[other]) ? 1 : 0;
    }
    if (touched >= 2 && rough > 0 && given.substeps < 4)
      return CoarseStep{
          fmt::format(
              "body {} leans on its edges: within two degrees of what friction holds it slips or sticks wrongly", i),
          "4 substeps hold it a degree from slipping", "ladder_stays"};
    if (touched == 1 && level == 1 && given.substeps < 8)
      return CoarseStep{
          fmt::format("body {} stands on an edge: it rocks or falls over by some hundredths less or more", i),
          "8 substeps with \"solver\": {\"kind\": \"dantzig\"} get it right", "rocking", "witnesses"};
  }
  return std::nullopt;
}

/// A body on one other, or a whole stack, whose centre of mass is nearly beside what bears it.
Found overhanging(const Given& given) {
  constexpr std::size_t few = 1000;
  const scenes::Solver& solver = given.subject.scene.solver;
  const bool is_exact = solver.kind == scenes::SolverKind::dantzig && given.substeps >= 4;
  if (given.gravity == 0 || given.subject.scene.world.tumbling || given.bodies.size() > few || given.substeps >= 8 ||
      is_exact || (solver.iterations >= 50 && given.substeps >= 2))
    return std::nullopt;
  // Measured of towers and overhangs of 2 to 16 boxes of half a metre to two: the more bodies, the sooner they fall.
  const auto falls_from = [](std::size_t bodies) { return std::max(0.1, 1.1 - 0.07 * static_cast<double>(bodies)); };
  const scenes::Vec3 up = scenes::times(given.subject.scene.world.gravity, -1 / given.gravity);
  const std::vector<Lean> leans = leans_of(given.subject, given.masses, up);
  constexpr double most_share = 1.25;  // what leans farther falls at once, with any setting
  const auto excess = [&](const Lean& lean) {
    return lean.share < most_share ? lean.share - falls_from(lean.bodies) : -1;
  };
  const auto worst =
      std::max_element(leans.begin(), leans.end(), [&](const Lean& a, const Lean& b) { return excess(a) < excess(b); });
  if (worst == leans.end() || excess(*worst) <= 0) return std::nullopt;
  if (worst->share > 1)
    return CoarseStep{
        fmt::format("a stack of {} bodies leans or overhangs by {:.3g} of what lets it fall: it falls too soon",
                    worst->bodies, worst->share),
        "\"solver\": {\"kind\": \"dantzig\"} lets it fall in time", "overhang_falls"};
  return CoarseStep{fmt::format("a stack of {} bodies leans or overhangs by {:.2g} of what lets it fall: it may fall",
                                worst->bodies, worst->share),
                    "8 substeps, or 4 with \"solver\": {\"kind\": \"dantzig\"}, hold it as far as 0.9",
                    "overhang_stands"};
}

Found weak_motor(const Given& given) {
  if (given.substeps > 1) return std::nullopt;
  for (const scenes::Joint& joint : given.subject.expanded.joints) {
    const auto* const hinge = std::get_if<scenes::HingeJoint>(&joint.value);
    if (hinge == nullptr || !hinge->motor || hinge->motor->speed != 0 || !given.moves_by_rows(joint.a)) continue;
    const scenes::Vec3 pull = across(given.subject.scene.world.gravity, hinge->axis);
    const double taken = size_of(geometry::cross(arm_of(given.centres[joint.a], *hinge), pull)) * given.masses[joint.a];
    if (taken == 0 || hinge->motor->max_force < taken || hinge->motor->max_force > 1.3 * taken) continue;
    return CoarseStep{fmt::format("a motor that holds a weight with {:.3g} of the torque that it takes: it gives",
                                  hinge->motor->max_force / taken),
                      "2 substeps hold it", "motor_holds"};
  }
  return std::nullopt;
}

/// What a motor turns about a point beside its centre goes straight in a step, and its joint comes apart.
Found fast_motor(const Given& given) {
  constexpr double most = 0.07;  // radians a step: beyond, the joint takes a tenth of the energy in some seconds
  for (const scenes::Joint& joint : given.subject.expanded.joints) {
    const auto* const hinge = std::get_if<scenes::HingeJoint>(&joint.value);
    if (hinge == nullptr || !hinge->motor || !hinge->motor->acts() || !given.moves_by_rows(joint.a)) continue;
    const double arm = size_of(arm_of(given.centres[joint.a], *hinge));
    const double turn = std::abs(hinge->motor->speed) * given.step;
    if (arm == 0 || turn <= most) continue;
    return CoarseStep{
        fmt::format("a motor turns a body by {:.2g} degrees in a step, {:.2g} m from its joint: it goes straight, "
                    "and the joint comes apart by some {:.1g} m",
                    turn * 180 / std::numbers::pi, arm, arm * (1 - std::cos(std::min(turn, 3.14)))),
        given.finer(turn / most), "whirled"};
  }
  return std::nullopt;
}

/// How fast the surface of a body comes nearer to something as it spins, in m/s: a ball's never does, nor what turns
/// about its own axis.
double approach(const Given& given, const Body& body, double half_thickness) {
  const scenes::ShapeValue& shape = given.subject.expanded.shapes[body.traits.shape].value;
  if (std::holds_alternative<scenes::SphereShape>(shape)) return 0;
  const bool is_round = std::holds_alternative<scenes::CylinderShape>(shape) ||
                        std::holds_alternative<scenes::CapsuleShape>(shape) ||
                        std::holds_alternative<scenes::ConeShape>(shape);
  const auto& [x, y, z, w] = body.rotation;
  const scenes::Vec3 axis{2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)};
  const double spin = size_of(is_round ? geometry::cross(axis, body.spin) : body.spin);
  const double reach = effects::size_of(given.subject.expanded.shapes, body.traits.shape).largest / 2;
  return spin * std::max(0.0, reach - half_thickness);
}

Found fast_meeting(const Given& given) {
  const std::vector<double> half = effects::half_thicknesses(given.subject.expanded.shapes);
  // What is fixed is pushed nowhere, if depth is no speed: landings.cpp is about that.
  const bool splits = given.subject.scene.solver.split_impulse;
  const auto is_pushed = [&](const Body& body) { return !splits || body.traits.type != scenes::BodyType::fixed; };
  const auto share = [&](const Body& body) {
    const double thin = half[body.traits.shape];
    return thin > 0 ? (size_of(body.velocity) + approach(given, body, thin)) * given.step / thin / 2 : 0;
  };
  const auto is_fast = [&](const Body& body) { return is_dynamic(body) && share(body) > 0.05; };
  const std::optional<std::size_t> first = given.subject.collidable.first(is_fast, is_pushed);
  if (!first || given.subject.scene.solver.bounces == scenes::Bounces::on_contact) return std::nullopt;
  return CoarseStep{
      fmt::format("body {} moves by {:.2g} of its thickness in a step: what it hits is pushed away too fast", *first,
                  share(given.bodies[*first])),
      "\"contact_erp\": 0, or more substeps, push less", "collision_3_0"};
}

}  // namespace

std::vector<CoarseStep> coarse_steps(const scenes::Scene& scene) {
  const scenes::Expanded expanded = scenes::expand(scene);
  const Subject subject{scene, expanded};
  const Given given(subject);
  std::vector<CoarseStep> found;
  for (const auto find : {swing, spin_on_a_joint, loop, bounce, thrown, drag, slide, leaning, overhanging, weak_motor,
                          fast_motor, fast_meeting})
    if (Found one = find(given)) found.push_back(std::move(*one));
  for (const auto find : {deep_landing, coarse_places})
    if (Found one = find(subject)) found.push_back(std::move(*one));
  return found;
}

}  // namespace boxstream::tool
