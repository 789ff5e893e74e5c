// SPDX-License-Identifier: MIT
#include "boxstream/advice/columns.hpp"

#include <boxstream/detector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "boxstream/advice/reaching.hpp"
#include "formats/geometry/frame.hpp"
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
      columns.awake = columns.awake || !bodies[i].traits.sleep || !bodies[bearer].traits.sleep;
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

double along(const btVector3& place, const scenes::Vec3& direction) {
  return direction[0] * place.x() + direction[1] * place.y() + direction[2] * place.z();
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

/// What of a body counts where it stands on another.
struct Extent {
  btVector3 middle{0, 0, 0}, half{0, 0, 0};  // of its box
};

struct Standing {
  Bearers bearers;
  std::vector<Extent> extents;
};

Standing standing(const Subject& subject, const std::vector<double>& masses, const scenes::Vec3& up) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  scenes::ShapeSet shapes(subject.expanded.shapes);
  Standing found{{std::vector<double>(bodies.size()), std::vector<std::vector<std::size_t>>(bodies.size())},
                 std::vector<Extent>(bodies.size())};
  Bearers& bearers = found.bearers;
  std::vector<double> reaches(bodies.size());
  std::vector<Aabb> boxes(bodies.size(), Aabb{{1, 1, 1}, {0, 0, 0}});  // invalid: pairs with nothing
  std::vector<Filter> filters;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    filters.push_back({body.traits.group.value_or(1), body.traits.mask.value_or(~0u)});
    if (masses[i] == 0) continue;
    btVector3 low, high;
    shapes.get(body.traits.shape).shape->getAabb(scenes::transform(body.position, body.rotation), low, high);
    const Extent extent{(low + high) / 2, (high - low) / 2};
    found.extents[i] = extent;
    bearers.levels[i] = along(extent.middle, up);
    reaches[i] = reach(extent.half, up);
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
  return found;
}

/// How far `load` is to the side of the middle of what two boxes share along a level direction, as a share of half the
/// narrower box: 1 lets it fall.
double lean_along(const scenes::Vec3& level, const scenes::Vec3& load, const Extent& above, const Extent& below) {
  const double a = along(above.middle, level), b = along(below.middle, level);
  const double half_a = reach(above.half, level), half_b = reach(below.half, level), half = std::min(half_a, half_b);
  const double low = std::max(a - half_a, b - half_b), high = std::min(a + half_a, b + half_b);
  const double at = load[0] * level[0] + load[1] * level[1] + load[2] * level[2];
  return 1 - std::min(at - low, high - at) / half;
}

/// Two directions across `up`, along axes of the world where that is.
std::array<scenes::Vec3, 2> level_directions(const scenes::Vec3& up) {
  const scenes::Vec3 aside = std::abs(up[1]) > 0.5 ? scenes::Vec3{0, 0, 1} : scenes::Vec3{0, 1, 0};
  const scenes::Vec3 first = geometry::cross(up, aside);
  const scenes::Vec3 level = scenes::times(first, 1 / std::sqrt(geometry::dot(first, first)));
  return {level, geometry::cross(level, up)};
}

}  // namespace

Columns stacks_of(const Subject& subject, const std::vector<double>& masses, const scenes::Vec3& up) {
  return columns_of(subject.expanded.bodies, masses, standing(subject, masses, up).bearers);
}

std::vector<Lean> leans_of(const Subject& subject, const std::vector<double>& masses, const scenes::Vec3& up) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  const auto [bearers, extents] = standing(subject, masses, up);
  const std::array<scenes::Vec3, 2> levels = level_directions(up);
  std::vector<std::size_t> order(bodies.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::vector<double>& heights = bearers.levels;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return heights[a] > heights[b]; });
  std::vector<double> mass = masses;
  std::vector<scenes::Vec3> moment(bodies.size());
  std::vector<std::size_t> count(bodies.size(), 1);
  std::vector<bool> shared(bodies.size());  // something of what it bears stands on others as well
  const std::vector<scenes::Vec3> centres = centres_of(subject);
  for (std::size_t i = 0; i < bodies.size(); ++i) moment[i] = scenes::times(centres[i], masses[i]);
  std::vector<Lean> found;
  for (const std::size_t i : order) {
    if (bearers.of[i].size() != 1 || shared[i]) {
      for (const std::size_t bearer : bearers.of[i]) shared[bearer] = true;
      continue;
    }
    const std::size_t bearer = bearers.of[i].front();
    const scenes::Vec3 load = scenes::times(moment[i], 1 / mass[i]);
    found.push_back({bearer, count[i] + 1,
                     std::max(lean_along(levels[0], load, extents[i], extents[bearer]),
                              lean_along(levels[1], load, extents[i], extents[bearer]))});
    mass[bearer] += mass[i];
    moment[bearer] = geometry::plus(moment[bearer], moment[i]);
    count[bearer] += count[i];
  }
  return found;
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
