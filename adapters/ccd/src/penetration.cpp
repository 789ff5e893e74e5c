// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core_distance.hpp"
#include "libccd.hpp"
#include "polytope.hpp"
#include "revolution.hpp"

namespace boxstream::ccd {
namespace {

using Solver = Options::Solver;

/// The shortest separating translation known so far. Its length follows from its direction, so lengths from solvers are
/// not needed.
struct MinimumTranslation {
  double width = std::numeric_limits<double>::infinity();  ///< of the cores along `direction`
  double floor = 0;                                        ///< proven lower bound of all widths
  double least = 0;                                        ///< lower bound of all widths, by a solver
  Vec direction = Vec::Zero();
  Method method = Method::none;
  bool limit = false;

  /// Widths of cores that share a point are not negative. Other widths are not below minus the distance, which is up to
  /// `cores.upper`.
  explicit MinimumTranslation(const CoreDistance& cores) : floor(-cores.upper), least(floor) {}

  void offer(const ShapePair& pair, const Vec& d, Method by) {
    const double length = d.norm();
    if (!(length > 0) || !std::isfinite(length)) return;
    const Vec unit = d / length;
    const double w = pair.core_width(unit);
    // Differences within rounding do not replace an earlier direction.
    if (w < width - pair.noise) width = w, direction = unit, method = by;
  }

  /// Takes a lower bound from a solver, unless a shorter translation is known.
  void claim_least(const ShapePair& pair, double depth) {
    if (depth <= width + pair.tolerance) least = std::max(least, std::min(depth, width));
  }
  /// Drops the lower bound of a solver if a known translation, or one of `other_width`, is shorter.
  void check_claim(const ShapePair& pair, double other_width) {
    if (least > std::min(width, other_width) + pair.tolerance) least = floor;
    least = std::min(least, width);
  }

  bool is_least(const ShapePair& pair) const { return width - least <= pair.tolerance; }
};

void offer_both(MinimumTranslation& out, const ShapePair& pair, const Vec& d, Method by) {
  out.offer(pair, d, by);
  out.offer(pair, -d, by);
}

void try_libccd_epa(MinimumTranslation& out, const ShapePair& pair, const Options& options, const Vec& first) {
  LibccdCall call(pair, LibccdCall::Of::cores, options.max_iterations, first);
  const LibccdAnswer answer = call.gjk_penetration();
  out.limit |= answer.limit;
  if (!(answer.direction.squaredNorm() > 0)) return;
  out.offer(pair, answer.direction, Method::epa);
  if (!answer.limit) out.claim_least(pair, answer.depth);
}

/// Points of a polytope after which local minima are searched instead, for curved surfaces: closing the gap between the
/// bounds would take thousands of points.
constexpr int round_points = 125;
/// Limits of gap and depth for local minima, in sizes of the smaller shape. In deeper contacts the tolerance is too
/// small a part of the depth to distinguish neighbouring minima.
constexpr double round_gap = 5e-3, round_depth = 25;

/// Searches for local minima from the shortest translation of each neighbourhood, the shortest first.
void refine_minima(MinimumTranslation& out, const ShapePair& pair, const Polytope& polytope) {
  constexpr int most_starts = 6;
  constexpr double nearby_cosine = 0.99;
  std::vector<std::pair<double, Vec>> translations = polytope.translations();
  translations.emplace_back(polytope.width(), polytope.direction());
  std::sort(translations.begin(), translations.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  // A search gains little more than the gap of the polytope.
  const double longest = out.width + 4 * (polytope.width() - polytope.least());
  int starts = 0;
  for (auto translation = translations.begin(); translation != translations.end() && starts < most_starts;
       ++translation) {
    const auto is_near = [&](const auto& shorter) { return shorter.second.dot(translation->second) > nearby_cosine; };
    if (translation->first > longest) break;
    if (std::any_of(translations.begin(), translation, is_near)) continue;
    ++starts;
    out.offer(pair, local_minimum(pair, translation->second).unit, Method::epa);
  }
}

void try_polytope(MinimumTranslation& out, const ShapePair& pair, const Options& options) {
  Polytope polytope(pair);
  polytope.add_known(out.width, out.direction);
  const auto grow = [&](int most_points) {
    polytope.grow(most_points);
    out.offer(pair, polytope.direction(), Method::epa);
    out.claim_least(pair, polytope.least());
  };
  if (pair.a.is_curved() || pair.b.is_curved()) {
    for (const int points : {round_points, 4 * round_points}) {
      if (points > options.max_iterations) break;
      grow(points);
      if (out.is_least(pair)) return;
      if (out.width > round_depth * pair.size) break;
      if (out.width - polytope.least() > round_gap * pair.size) continue;
      refine_minima(out, pair, polytope);
      out.least = out.width;
      return;
    }
  }
  grow(options.max_iterations);
  out.limit |= polytope.limit();
}

void try_mpr(MinimumTranslation& out, const ShapePair& pair, const Options& options) {
  LibccdCall call(pair, LibccdCall::Of::cores, options.max_iterations, Vec::UnitX());
  const LibccdAnswer answer = call.mpr_penetration();
  out.limit |= answer.limit;
  if (answer.direction.squaredNorm() > 0) out.offer(pair, answer.direction, Method::mpr);
}

/// Directions that need no solver: the last separating direction of the cores, normals of the last simplex, face
/// normals of both shapes, and cross products of their edges or axes.
void try_axes(MinimumTranslation& out, const ShapePair& pair, const CoreDistance& cores) {
  offer_both(out, pair, cores.direction, Method::axes);
  const Simplex& s = cores.simplex;
  for (int i = 0; i < s.size; ++i)
    for (int j = i + 1; j < s.size; ++j)
      for (int k = j + 1; k < s.size; ++k)
        offer_both(out, pair, (s[j].w - s[i].w).cross(s[k].w - s[i].w), Method::axes);
  const Eigen::Matrix3d &p = pair.a.rotation(), &q = pair.b.rotation();
  for (int i = 0; i < 3; ++i) {
    // Not the columns themselves: the matrix need not be exactly a rotation.
    for (const Eigen::Matrix3d* const axes : {&p, &q})
      offer_both(out, pair, axes->col((i + 1) % 3).cross(axes->col((i + 2) % 3)), Method::axes);
    for (int j = 0; j < 3; ++j) offer_both(out, pair, p.col(i).cross(q.col(j)), Method::axes);
  }
  if (const auto normals = profile_normals(pair))
    for (const Vec& normal : *normals) offer_both(out, pair, normal, Method::axes);
}

/// A translation of B a little longer than the separating one, so that the shapes are disjoint.
Vec clear_of(const ShapePair& pair, const Vec& direction, double width) {
  const double clearance = std::max(1e-3, 16 * pair.tolerance);
  return direction * (width + clearance + pair.noise);
}

/// Separates the shapes and takes the direction of their distance: often a shorter separating translation. It finds
/// shallow contacts of corners and edges, where solvers and axes are far off.
void shorten(MinimumTranslation& out, const ShapePair& pair, const Options& options) {
  constexpr int most_times = 8;
  for (int i = 0; i < most_times && !out.is_least(pair); ++i) {
    ShapePair apart = pair;
    apart.b.move(clear_of(pair, out.direction, out.width));
    const double before = out.width;
    out.offer(pair, core_distance(apart, options.max_iterations).direction, Method::cores);
    if (!(out.width < before)) return;
  }
}

/// True if the minimum is among the directions of `try_axes`: for boxes, segments and points, and for solids of
/// revolution with parallel axes.
bool axes_suffice(const ShapePair& pair) {
  return (pair.a.is_boxy() && pair.b.is_boxy()) || profile_normals(pair);
}

/// libccd's GJK and EPA. A first direction through an edge or a corner of A - B makes libccd report a deep contact as a
/// touch, so several first directions are tried until there is an answer.
void try_gjk(MinimumTranslation& out, const ShapePair& pair, const Options& options) {
  static const Vec starts[] = {{0.48, 0.36, 0.8}, {-0.6, 0.64, -0.48}, {0.28, -0.96, 0.1}, {-0.9, -0.3, 0.2},
                               {0.1, 0.2, -0.9},  {0.6, -0.5, -0.5},   {-0.3, 0.1, 0.9}};
  for (const Vec& start : starts) {
    try_libccd_epa(out, pair, options, start);
    if (out.method != Method::none) return;
  }
}

/// The minimum translation of two cores that overlap, nearly overlap, or are not known to be disjoint.
MinimumTranslation minimum_translation(const ShapePair& pair, const CoreDistance& cores, const Options& options) {
  MinimumTranslation out(cores), axes(cores);
  if (options.solver == Solver::mpr) {
    try_mpr(out, pair, options);
    out.least = out.width;
    if (out.method != Method::none) return out;
    out.least = out.floor;
  }
  try_axes(axes, pair, cores);
  if (options.solver == Solver::gjk) {
    try_gjk(out, pair, options);
    out.check_claim(pair, axes.width);
    if (out.method != Method::none) return out;
  }
  if (axes_suffice(pair)) {
    axes.least = axes.width;
    return axes;
  }
  try_polytope(axes, pair, options);
  if (!axes.is_least(pair)) shorten(axes, pair, options);
  return axes;
}

/// Sets the deepest points: the closest points after B has been moved out of A.
void set_points(Penetration& result, const ShapePair& pair, double depth, const Options& options) {
  const Vec& n = result.direction;
  ShapePair apart = pair;
  const Vec move = clear_of(pair, n, depth);
  apart.b.move(move);
  const CoreDistance cores = core_distance(apart, options.max_iterations);
  result.on_a = pair.to_world(cores.on_a + n * pair.a.rounding());
  result.on_b = pair.to_world(cores.on_b - n * pair.b.rounding() - move);
}

}  // namespace

Penetration penetration(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                        const Options& options) {
  Penetration result;
  const auto pair = make_shape_pair(a, pose_a, b, pose_b, options);
  if (!pair) return result;
  const CoreDistance cores = core_distance(*pair, options.max_iterations, {pair->rounding + pair->noise, -1});
  if (cores.lower > pair->rounding + pair->noise) {
    result.status = Status::ok;
    result.method = Method::cores;
    return result;
  }

  MinimumTranslation out(cores);
  if (!cores.overlap) {
    out.offer(*pair, cores.direction, Method::cores);
    out.limit = cores.limit;
  }
  // Also for cores that nearly touch: the shorter the distance, the less certain the plane between them.
  if (cores.overlap || !out.is_least(*pair)) {
    out = minimum_translation(*pair, cores, options);
    out.limit |= cores.limit;
  }
  if (out.method == Method::none) return result;  // not reached: the axes of A are always offered
  if (-out.width > pair->rounding + pair->noise) {
    // Iterations ended before a separating plane was found, and another solver has found one.
    result.status = Status::ok;
    result.method = out.method;
    return result;
  }
  const double depth = std::max(0.0, out.width + pair->rounding);
  result.intersects = true;
  result.method = out.method;
  result.direction = out.direction;
  result.depth = depth / pair->scale;
  result.status = out.is_least(*pair) ? Status::ok : out.limit ? Status::iteration_limit : Status::inexact;
  set_points(result, *pair, depth, options);
  return result;
}

}  // namespace boxstream::ccd
