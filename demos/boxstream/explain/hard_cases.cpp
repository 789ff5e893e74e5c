// SPDX-License-Identifier: MIT
#include "boxstream/explain/hard_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "simulation/effects/find.hpp"
#include "simulation/effects/tunnelling.hpp"
#include "simulation/engine/bullet_shapes.hpp"

namespace boxstream::tool {
namespace {

using effects::Subject;
using scenes::Body;

constexpr std::size_t no_depth = std::numeric_limits<std::size_t>::max();

/// Iterations of the solver in a step, over its substeps.
int effort_of(const scenes::Scene& scene) {
  return scene.time.substeps * scene.solver.iterations;
}

std::vector<double> masses_of(const Subject& subject) {
  scenes::ShapeSet shapes(subject.expanded.shapes);
  std::vector<double> masses;
  for (const Body& body : subject.expanded.bodies) {
    const scenes::BodyTraits& traits = body.traits;
    masses.push_back(!effects::is_dynamic(body) ? 0
                     : traits.mass              ? *traits.mass
                                                : *traits.density * shapes.get(traits.shape).volume);
  }
  return masses;
}

void find_mass_ratio(const Subject& subject, const std::vector<double>& masses, std::vector<HardCase>& found) {
  double least = std::numeric_limits<double>::max(), most = 0;
  for (const double mass : masses) {
    if (mass == 0) continue;
    least = std::min(least, mass);
    most = std::max(most, mass);
  }
  if (most < 200 * least || effort_of(subject.scene) >= 100) return;
  const auto mass_of = [&](const Body& body) {
    return masses[static_cast<std::size_t>(&body - subject.expanded.bodies.data())];
  };
  const auto is_heavy = [&](const Body& body) { return mass_of(body) >= 200 * least; };
  const auto is_light = [&](const Body& body) { return mass_of(body) > 0 && mass_of(body) <= most / 200; };
  if (!subject.meetings.first(is_heavy, is_light)) return;
  found.push_back(
      {fmt::format("bodies of {:.3g} to {:.3g} kg: a heavy one sinks into a light one that it rests on", least, most),
       "2 substeps of 50 iterations", "mass_ratio_1000_stable"});
}

/// Joints between each body and what cannot be moved; no_depth if there is no such way.
std::vector<std::size_t> joint_depths(const Subject& subject) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  std::vector<std::vector<std::size_t>> joined(bodies.size());
  std::vector<std::size_t> depths(bodies.size(), no_depth), queue;
  const auto reach = [&](std::size_t body, std::size_t depth) {
    if (depths[body] <= depth) return;
    depths[body] = depth;
    queue.push_back(body);
  };
  for (const scenes::Joint& joint : subject.expanded.joints) {
    if (!joint.b) {
      reach(joint.a, 1);
      continue;
    }
    joined[joint.a].push_back(*joint.b);
    joined[*joint.b].push_back(joint.a);
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!joined[i].empty() && !effects::is_dynamic(bodies[i])) reach(i, 0);
  // Nearest first, as the rest is found.
  std::stable_sort(queue.begin(), queue.end(), [&](std::size_t a, std::size_t b) { return depths[a] < depths[b]; });
  for (std::size_t at = 0; at < queue.size(); ++at)
    for (const std::size_t next : joined[queue[at]]) reach(next, depths[queue[at]] + 1);
  return depths;
}

void find_chain(const Subject& subject, const std::vector<double>& masses, std::vector<HardCase>& found) {
  const std::vector<std::size_t> depths = joint_depths(subject);
  std::size_t longest = 0;
  double lightest = std::numeric_limits<double>::max(), heaviest = 0;
  for (std::size_t i = 0; i < depths.size(); ++i) {
    if (depths[i] == no_depth || masses[i] == 0) continue;
    longest = std::max(longest, depths[i]);
    lightest = std::min(lightest, masses[i]);
    heaviest = std::max(heaviest, masses[i]);
  }
  if (longest < 30) return;
  const int effort = effort_of(subject.scene);
  if (heaviest >= 50 * lightest && effort < 40)
    found.push_back({fmt::format("a chain of {} joints with a body of {:.3g} times the mass of a link: it stretches",
                                 longest, heaviest / lightest),
                     "4 substeps", "ball_and_chain_stable"});
  else if (longest >= 80 && effort < 30)
    found.push_back({fmt::format("a chain of {} joints: it stretches", longest), "3 substeps", "chain_160_stable"});
  else if (effort < 20)
    found.push_back({fmt::format("a chain of {} joints: it stretches", longest), "20 iterations", "chain_40_stable"});
}

void find_bounce(const Subject& subject, std::vector<HardCase>& found) {
  const auto is_elastic = [](const Body& body) { return body.traits.material.restitution >= 0.99; };
  if (subject.scene.time.substeps >= 4 || subject.scene.world.gravity == scenes::Vec3{} ||
      !subject.meetings.first(is_elastic, is_elastic))
    return;
  found.push_back({"bodies of restitution 1 under gravity: bounces gain energy", "4 substeps", "bounce_energy_stable"});
}

void find_thin_on_mesh(const Subject& subject, std::vector<HardCase>& found) {
  const std::vector<scenes::Shape>& shapes = subject.expanded.shapes;
  const auto is_thin = [&](const Body& body) {
    return effects::is_dynamic(body) && effects::half_thickness(shapes, body.traits.shape) < 0.03;
  };
  const auto is_mesh = [&](const Body& body) {
    return std::holds_alternative<scenes::MeshShape>(shapes[body.traits.shape].value);
  };
  if (subject.scene.time.substeps >= 8 || !subject.meetings.first(is_thin, is_mesh)) return;
  found.push_back({"bodies thinner than 6 cm on a mesh: fast ones fall through", "8 substeps of 20 iterations",
                   "thin_boxes_on_mesh_stable"});
}

}  // namespace

std::vector<HardCase> hard_cases(const scenes::Scene& scene) {
  const scenes::Expanded expanded = scenes::expand(scene);
  const Subject subject{scene, expanded};
  const std::vector<double> masses = masses_of(subject);
  std::vector<HardCase> found;
  find_mass_ratio(subject, masses, found);
  find_chain(subject, masses, found);
  find_bounce(subject, found);
  find_thin_on_mesh(subject, found);
  return found;
}

}  // namespace boxstream::tool
