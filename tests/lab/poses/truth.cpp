// SPDX-License-Identifier: MIT
#include "truth.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "body.hpp"

namespace boxstream::poses {
namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();

Real gap(const Body& a, const Body& b, const Vec& unit) {
  return -b.reach(-unit) - a.reach(unit);
}

/// Every direction that separates two shapes best joins two of their faces, edges and corners.
std::vector<Vec> directions(const Body& a, const Body& b) {
  std::vector<Vec> all = {Vec::UnitX(), Vec::UnitY(), Vec::UnitZ()};
  const auto add = [&](const Vec& direction) {
    if (const Real length = direction.norm(); length > 0) all.push_back(direction / length);
  };
  const auto from_edges = [&](const Body& one, const Body& other) {
    for (const Vec& normal : one.normals) add(normal);
    for (const auto& [start, along] : one.edges)
      for (const Vec& p : other.points) {
        const Vec across = p - start - (p - start).dot(along) * along;
        // Once more: where this is short, what rounding left along the edge is not short beside it.
        if (const Real length = across.norm(); length > 0) add(across / length - (across / length).dot(along) * along);
      }
  };
  from_edges(a, b);
  from_edges(b, a);
  for (const auto& [start_a, u] : a.edges)
    for (const auto& [start_b, v] : b.edges) add(u.cross(v));
  for (const Vec& p : a.points)
    for (const Vec& q : b.points) add(q - p);
  return all;
}

/// A direction where the gap is large, and how large.
struct Found {
  Real gap;
  Vec unit;
};

/// Directions all around, about a tenth apart.
std::vector<Vec> all_around() {
  constexpr int count = 600;
  std::vector<Vec> all;
  for (int i = 0; i < count; ++i) {
    const Real z = 1 - (2 * i + 1.0L) / count, angle = i * std::numbers::pi_v<Real> * (3 - std::sqrt(5.0L));
    all.push_back({std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z});
  }
  return all;
}

/// Steps to where the gap is larger, in directions that turn from try to try, shorter when there is none.
Real refine(const Body& a, const Body& b, Found found) {
  Real angle = 0, step = 0.1L;
  for (int round = 0; round < 400 && step > 1e-13L; ++round) {
    const Vec u = found.unit.unitOrthogonal(), v = found.unit.cross(u);
    bool better = false;
    for (int i = 0; i < 8 && !better; ++i) {
      angle += 2.399963229728653L;
      const Vec next = (found.unit + step * (std::cos(angle) * u + std::sin(angle) * v)).normalized();
      if (const Real there = gap(a, b, next); there > found.gap) found = {there, next}, better = true;
    }
    if (!better) step *= 0.6L;
  }
  return found.gap;
}

/// The largest gap along a circle of directions: steps of half a degree, and a section by thirds around the best.
Real best_on_ring(const Body& a, const Body& b, const Vec& axis, Real along) {
  const Vec u = axis.unitOrthogonal(), v = axis.cross(u);
  const Real across = std::sqrt(std::max<Real>(1 - along * along, 0));
  const auto at = [&](Real angle) {
    return gap(a, b, along * axis + across * (std::cos(angle) * u + std::sin(angle) * v));
  };
  constexpr int steps = 720;
  const Real step = 2 * std::numbers::pi_v<Real> / steps;
  std::vector<Real> value(steps);
  for (int i = 0; i < steps; ++i) value[static_cast<std::size_t>(i)] = at(i * step);
  Real best = *std::max_element(value.begin(), value.end());
  for (int i = 0; i < steps; ++i) {
    const auto here = value[static_cast<std::size_t>(i)];
    const auto before = value[static_cast<std::size_t>((i + steps - 1) % steps)];
    const auto after = value[static_cast<std::size_t>((i + 1) % steps)];
    if (here < before || here < after || here + (std::abs(here - before) + std::abs(here - after)) < best) continue;
    Real low = (i - 1) * step, high = (i + 1) * step;
    for (int k = 0; k < 100; ++k) {
      const Real third = (high - low) / 3;
      at(low + third) < at(high - third) ? low += third : high -= third;
    }
    best = std::max(best, at((low + high) / 2));
  }
  return best;
}

/// The best direction is one of `directions`; or one across an edge or a round side; or one at which the gap is smooth,
/// since then one corner and one point of a rim are what is closest.
Real best_with_circles(const Body& a, const Body& b, std::vector<Found> tried) {
  for (const Vec& unit : all_around()) tried.push_back({gap(a, b, unit), unit});
  std::sort(tried.begin(), tried.end(), [](const Found& x, const Found& y) { return x.gap > y.gap; });
  Real best = tried[0].gap;
  std::vector<std::pair<Vec, Real>> rings;
  for (const Body* const body : {&a, &b}) {
    for (const auto& edge : body->edges) rings.push_back({edge.second, 0});
    rings.insert(rings.end(), body->rings.begin(), body->rings.end());
    for (const auto& [axis, along] : body->rings) rings.push_back({axis, -along});
  }
  std::vector<std::pair<Vec, Real>> done;
  for (const auto& [axis, along] : rings) {
    const auto is_same = [&, &x = axis, y = along](const auto& other) {
      return std::abs(other.first.dot(x)) > 1 - 1e-15L && std::abs(other.second) == std::abs(y) &&
             (y == 0 || other.first.dot(x) * other.second * y > 0);
    };
    if (std::any_of(done.begin(), done.end(), is_same)) continue;
    done.push_back({axis, along});
    best = std::max(best, best_on_ring(a, b, axis, along));
  }
  // Those close to a direction that was refined lead to the same place.
  std::vector<Vec> refined;
  for (const Found& found : tried) {
    if (std::any_of(refined.begin(), refined.end(), [&](const Vec& r) { return r.dot(found.unit) > 0.95L; })) continue;
    refined.push_back(found.unit);
    best = std::max(best, refine(a, b, found));
    if (refined.size() == 6) break;
  }
  return best;
}

Found best_of(const std::vector<Found>& tried) {
  return *std::max_element(tried.begin(), tried.end(), [](const Found& x, const Found& y) { return x.gap < y.gap; });
}

std::vector<Found> try_directions(const Body& a, const Body& b) {
  std::vector<Found> tried;
  for (const Vec& unit : directions(a, b))
    for (const Vec& way : {unit, Vec(-unit)}) tried.push_back({gap(a, b, way), way});
  return tried;
}

Real signed_distance_of(const Body& a, const Body& b) {
  if (a.below_plane) return -b.reach(-a.normals[0]) - a.normals[0].dot(a.points[0]);
  if (b.below_plane) return signed_distance_of(b, a);
  const std::vector<Found> tried = try_directions(a, b);
  return a.discs.empty() && b.discs.empty() ? best_of(tried).gap : best_with_circles(a, b, tried);
}

bool is_round(const Solid& solid) {
  return solid.kind == Kind::cylinder || solid.kind == Kind::cone;
}

}  // namespace

Real gap_along(const Solid& a, const Solid& b, const Eigen::Vector3d& direction) {
  return gap(body_of(a, a.translation), body_of(b, a.translation), direction.cast<Real>().normalized());
}

Eigen::Vector3d way_apart(const Solid& a, const Solid& b) {
  return best_of(try_directions(body_of(a, a.translation), body_of(b, a.translation))).unit.cast<double>();
}

Real signed_distance_of_convex(const Solid& a, const Solid& b) {
  return signed_distance_of(body_of(a, a.translation), body_of(b, a.translation));
}

Real signed_distance(const Solid& a, const Solid& b) {
  Real least = infinity;
  for (const Solid& part_a : parts(a))
    for (const Solid& part_b : parts(b)) least = std::min(least, signed_distance_of_convex(part_a, part_b));
  return least;
}

bool is_exact(const Solid& a, const Solid& b) {
  const bool has_plane = a.kind == Kind::half_space || b.kind == Kind::half_space;
  return has_plane || (!is_round(a) && !is_round(b));
}

Eigen::Vector3d middle_of(const Solid& solid) {
  if (solid.points.empty()) return Eigen::Vector3d::Zero();
  Eigen::Vector3d low = solid.points.front(), high = low;
  for (const Eigen::Vector3d& p : solid.points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return low / 2 + high / 2;
}

double radius(const Solid& solid) {
  switch (solid.kind) {
    case Kind::half_space:
      return std::numeric_limits<double>::infinity();
    case Kind::sphere:
      return solid.size[0];
    case Kind::capsule:
      return solid.size[0] + solid.size[1] / 2;
    case Kind::cylinder:
    case Kind::cone:
      return std::hypot(solid.size[0], solid.size[1] / 2);
    default: {
      const Eigen::Vector3d middle = middle_of(solid);
      double most = 0;
      for (const Eigen::Vector3d& p : solid.points) most = std::max(most, (p - middle).norm());
      return most;
    }
  }
}

double extent(const Solid& a, const Solid& b) {
  const auto finite = [](double r) { return std::isfinite(r) ? r : 0; };
  return finite(radius(a)) + finite(radius(b)) + middle_of(a).norm() + middle_of(b).norm() +
         (b.translation - a.translation).norm();
}

}  // namespace boxstream::poses
