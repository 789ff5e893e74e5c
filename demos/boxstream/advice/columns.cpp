// SPDX-License-Identifier: MIT
#include "boxstream/advice/columns.hpp"

#include <boxstream/detector.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "simulation/effects/find.hpp"
#include "simulation/engine/bullet_shapes.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::tool {
namespace {

using effects::Subject;
using scenes::Body;

/// Which dynamic bodies share the weight of each body. Every one of them has a lower level.
struct Bearers {
  std::vector<double> levels;
  std::vector<std::vector<std::size_t>> of;
};

double distance(const scenes::Vec3& a, const scenes::Vec3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Columns columns_of(const std::vector<Body>& bodies, const std::vector<double>& masses, const Bearers& bearers) {
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return bearers.levels[a] > bearers.levels[b]; });
  std::vector<double> borne(bodies.size());
  std::vector<std::size_t> count(bodies.size(), 1);
  Columns columns;
  double sum = 0;
  std::size_t links = 0;
  for (const std::size_t i : order) {
    // All that i bears comes before it.
    if (count[i] > 1)
      columns.list.push_back({count[i], std::max(1.0, borne[i] / masses[i] - static_cast<double>(count[i] - 2))});
    for (const std::size_t bearer : bearers.of[i]) {
      borne[bearer] += (borne[i] + masses[i]) / static_cast<double>(bearers.of[i].size());
      count[bearer] = std::max(count[bearer], count[i] + 1);
      sum += distance(bodies[i].position, bodies[bearer].position);
      ++links;
    }
  }
  if (links > 0) columns.size = sum / static_cast<double>(links);
  return columns;
}

/// How far a box reaches from its middle along a direction.
double reach(const btVector3& half, const scenes::Vec3& direction) {
  return std::abs(direction[0]) * half.x() + std::abs(direction[1]) * half.y() + std::abs(direction[2]) * half.z();
}

std::set<std::pair<std::size_t, std::size_t>> excluded_pairs(const scenes::Expanded& expanded) {
  std::set<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [a, b] : expanded.exclusions) pairs.insert(std::minmax(a, b));
  for (const scenes::Joint& joint : expanded.joints)
    if (joint.b && !joint.collide) pairs.insert(std::minmax(joint.a, *joint.b));
  return pairs;
}

/// Joints between each body and what cannot be moved; infinite if there is no such way.
std::vector<double> joint_depths(const std::vector<Body>& bodies, const std::vector<std::vector<std::size_t>>& joined,
                                 std::vector<std::size_t> held_by_world) {
  std::vector<double> depths(bodies.size(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> queue;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    if (!joined[i].empty() && !effects::is_dynamic(bodies[i])) {
      depths[i] = 0;
      queue.push_back(i);
    }
  for (const std::size_t i : held_by_world) {
    if (depths[i] <= 1) continue;
    depths[i] = 1;
    queue.push_back(i);
  }
  for (std::size_t at = 0; at < queue.size(); ++at)
    for (const std::size_t next : joined[queue[at]]) {
      if (depths[next] <= depths[queue[at]] + 1) continue;
      depths[next] = depths[queue[at]] + 1;
      queue.push_back(next);
    }
  return depths;
}

}  // namespace

Columns stacks_of(const Subject& subject, const std::vector<double>& masses, const scenes::Vec3& up) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  scenes::ShapeSet shapes(subject.expanded.shapes);
  Bearers bearers{std::vector<double>(bodies.size()), std::vector<std::vector<std::size_t>>(bodies.size())};
  std::vector<double> reaches(bodies.size());
  std::vector<Aabb> boxes(bodies.size(), Aabb{{1, 1, 1}, {0, 0, 0}});  // invalid: pairs with nothing
  std::vector<Filter> filters;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    filters.push_back({body.traits.group.value_or(1), body.traits.mask.value_or(~0u)});
    if (masses[i] == 0) continue;
    btVector3 low, high;
    shapes.get(body.traits.shape).shape->getAabb(scenes::transform(body.position, body.rotation), low, high);
    const btVector3 middle = (low + high) / 2, half = (high - low) / 2;
    bearers.levels[i] = up[0] * middle.x() + up[1] * middle.y() + up[2] * middle.z();
    reaches[i] = reach(half, up);
    // Stacks often start with small gaps.
    const auto gap = static_cast<float>(0.05 * reaches[i]);
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] = static_cast<float>(low[d]) - gap;
      boxes[i].max[d] = static_cast<float>(high[d]) + gap;
    }
  }
  const std::set<std::pair<std::size_t, std::size_t>> excluded = excluded_pairs(subject.expanded);
  std::vector<Pair> pairs;
  Detector().find_pairs(boxes, pairs, filters);
  for (const Pair& pair : pairs) {
    std::size_t above = pair.a, below = pair.b;
    if (excluded.count({above, below}) > 0) continue;
    if (bearers.levels[above] < bearers.levels[below]) std::swap(above, below);
    if (bearers.levels[above] - reaches[above] > bearers.levels[below]) bearers.of[above].push_back(below);
  }
  return columns_of(bodies, masses, bearers);
}

Columns chains_of(const Subject& subject, const std::vector<double>& masses) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  std::vector<std::vector<std::size_t>> joined(bodies.size());
  std::vector<std::size_t> held_by_world;
  for (const scenes::Joint& joint : subject.expanded.joints) {
    if (std::holds_alternative<scenes::GearJoint>(joint.value)) continue;  // bears nothing
    if (!joint.b) {
      held_by_world.push_back(joint.a);
      continue;
    }
    joined[joint.a].push_back(*joint.b);
    joined[*joint.b].push_back(joint.a);
  }
  Bearers bearers{joint_depths(bodies, joined, held_by_world), std::vector<std::vector<std::size_t>>(bodies.size())};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (std::isinf(bearers.levels[i])) continue;
    for (const std::size_t other : joined[i])
      if (masses[other] > 0 && bearers.levels[other] < bearers.levels[i]) bearers.of[i].push_back(other);
  }
  return columns_of(bodies, masses, bearers);
}

}  // namespace boxstream::tool
