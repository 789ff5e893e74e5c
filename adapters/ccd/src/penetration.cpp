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

/// The shortest way out that is known. Every direction gives a way out whose length is easily computed, so what a
/// solver says of its direction's length need not be believed.
struct WayOut {
  double width = std::numeric_limits<double>::infinity();  ///< of the cores along `direction`
  double floor = 0;                                        ///< no way out is shorter, whatever a solver says
  double least = 0;                                        ///< no way out is shorter, as far as a solver knows
  Vec direction = Vec::Zero();
  Method method = Method::none;
  bool limit = false;

  /// Cores that share a point have no way out below zero. Those that may not have none that is shorter than their
  /// distance, which is not above `cores.upper`.
  explicit WayOut(const CoreDistance& cores) : floor(-cores.upper), least(floor) {}

  void offer(const Couple& couple, const Vec& d, Method by) {
    const double length = d.norm();
    if (!(length > 0) || !std::isfinite(length)) return;
    const Vec unit = d / length;
    const double w = couple.core_width(unit);
    // What differs by rounding only does not take the place of what came first.
    if (w < width - couple.noise) width = w, direction = unit, method = by;
  }

  /// A solver says that no way out is shorter than `depth`. If a shorter one is known, it is wrong.
  void claim_least(const Couple& couple, double depth) {
    if (depth <= width + couple.tolerance) least = std::max(least, std::min(depth, width));
  }
  /// Forgets the claim if one of the ways out known, or this other one, is too short for it.
  void check_claim(const Couple& couple, double other_width) {
    if (least > std::min(width, other_width) + couple.tolerance) least = floor;
    least = std::min(least, width);
  }

  bool is_least(const Couple& couple) const { return width - least <= couple.tolerance; }
};

void offer_both(WayOut& out, const Couple& couple, const Vec& d, Method by) {
  out.offer(couple, d, by);
  out.offer(couple, -d, by);
}

void ask_libccd_epa(WayOut& out, const Couple& couple, const Options& options, const Vec& first) {
  LibccdCall call(couple, LibccdCall::Of::cores, options.max_iterations, first);
  const LibccdAnswer answer = call.gjk_penetration();
  out.limit |= answer.limit;
  if (!(answer.direction.squaredNorm() > 0)) return;
  out.offer(couple, answer.direction, Method::epa);
  if (!answer.limit) out.claim_least(couple, answer.depth);
}

/// Points of a polytope after which what is round about the origin is known well enough to look for its lowest places
/// instead: closing the gap between the bounds would take thousands.
constexpr int round_points = 125;
/// These lowest places are believed for a gap up to this, and a depth up to this, both in sizes of the smaller shape:
/// deeper, the tolerance is too small a part of the depth to tell one low place from the next.
constexpr double round_gap = 5e-3, round_depth = 25;

/// Looks downhill from those ways out that are shorter than all that were met nearby, the shortest first.
void go_downhill(WayOut& out, const Couple& couple, const Polytope& polytope) {
  constexpr int most_starts = 6;
  constexpr double nearby_cosine = 0.99;
  std::vector<std::pair<double, Vec>> ways = polytope.ways();
  ways.emplace_back(polytope.width(), polytope.direction());
  std::sort(ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  // Little more than what the polytope leaves open can be gained from one.
  const double longest = out.width + 4 * (polytope.width() - polytope.least());
  int starts = 0;
  for (auto way = ways.begin(); way != ways.end() && starts < most_starts; ++way) {
    const auto is_near = [&](const auto& shorter) { return shorter.second.dot(way->second) > nearby_cosine; };
    if (way->first > longest) break;
    if (std::any_of(ways.begin(), way, is_near)) continue;
    ++starts;
    out.offer(couple, downhill(couple, way->second).unit, Method::epa);
  }
}

void ask_polytope(WayOut& out, const Couple& couple, const Options& options) {
  Polytope polytope(couple);
  polytope.know(out.width, out.direction);
  const auto grow = [&](int most_points) {
    polytope.grow(most_points);
    out.offer(couple, polytope.direction(), Method::epa);
    out.claim_least(couple, polytope.least());
  };
  if (couple.a.is_curved() || couple.b.is_curved()) {
    for (const int points : {round_points, 4 * round_points}) {
      if (points > options.max_iterations) break;
      grow(points);
      if (out.is_least(couple)) return;
      if (out.width > round_depth * couple.size) break;
      if (out.width - polytope.least() > round_gap * couple.size) continue;
      go_downhill(out, couple, polytope);
      out.least = out.width;
      return;
    }
  }
  grow(options.max_iterations);
  out.limit |= polytope.limit();
}

void ask_mpr(WayOut& out, const Couple& couple, const Options& options) {
  LibccdCall call(couple, LibccdCall::Of::cores, options.max_iterations, Vec::UnitX());
  const LibccdAnswer answer = call.mpr_penetration();
  out.limit |= answer.limit;
  if (answer.direction.squaredNorm() > 0) out.offer(couple, answer.direction, Method::mpr);
}

/// Directions that need no solver: the last one in which the cores looked apart, normals of what the distance algorithm
/// saw of A - B, the faces of both shapes and what is square to two of their edges or axes.
void ask_axes(WayOut& out, const Couple& couple, const CoreDistance& cores) {
  offer_both(out, couple, cores.direction, Method::axes);
  const Simplex& s = cores.simplex;
  for (int i = 0; i < s.size; ++i)
    for (int j = i + 1; j < s.size; ++j)
      for (int k = j + 1; k < s.size; ++k)
        offer_both(out, couple, (s[j].w - s[i].w).cross(s[k].w - s[i].w), Method::axes);
  const Eigen::Matrix3d &p = couple.a.rotation(), &q = couple.b.rotation();
  for (int i = 0; i < 3; ++i) {
    // Not the columns themselves: the matrix need not be exactly a rotation.
    for (const Eigen::Matrix3d* const axes : {&p, &q})
      offer_both(out, couple, axes->col((i + 1) % 3).cross(axes->col((i + 2) % 3)), Method::axes);
    for (int j = 0; j < 3; ++j) offer_both(out, couple, p.col(i).cross(q.col(j)), Method::axes);
  }
  if (const auto normals = profile_normals(couple))
    for (const Vec& normal : *normals) offer_both(out, couple, normal, Method::axes);
}

/// B where it has left A along a way out, and a little farther, so that they are surely apart.
Vec clear_of(const Couple& couple, const Vec& direction, double width) {
  const double clearance = std::max(1e-3, 16 * couple.tolerance);
  return direction * (width + clearance + couple.noise);
}

/// Looks from there which way they are closest: seldom a longer way out, often a shorter one. What barely touches at
/// corners and edges is found like this when solvers and the shapes' own directions are far off.
void shorten(WayOut& out, const Couple& couple, const Options& options) {
  constexpr int most_times = 8;
  for (int i = 0; i < most_times && !out.is_least(couple); ++i) {
    Couple apart = couple;
    apart.b.move(clear_of(couple, out.direction, out.width));
    const double before = out.width;
    out.offer(couple, core_distance(apart, options.max_iterations).direction, Method::cores);
    if (!(out.width < before)) return;
  }
}

/// True if the directions that `ask_axes` offers are all that can be the best: of boxes, segments and points, and of
/// bodies of revolution whose axes are parallel.
bool axes_suffice(const Couple& couple) {
  return (couple.a.is_boxy() && couple.b.is_boxy()) || profile_normals(couple);
}

/// libccd's GJK and EPA. A start that happens to lead through an edge or a corner of A - B makes it take a deep contact
/// for a touch, so it is asked from others until it has a direction.
void ask_gjk(WayOut& out, const Couple& couple, const Options& options) {
  static const Vec starts[] = {{0.48, 0.36, 0.8}, {-0.6, 0.64, -0.48}, {0.28, -0.96, 0.1}, {-0.9, -0.3, 0.2},
                               {0.1, 0.2, -0.9},  {0.6, -0.5, -0.5},   {-0.3, 0.1, 0.9}};
  for (const Vec& start : starts) {
    ask_libccd_epa(out, couple, options, start);
    if (out.method != Method::none) return;
  }
}

/// The way out of two cores that share a point, or nearly, or that are not known to be apart.
WayOut way_out(const Couple& couple, const CoreDistance& cores, const Options& options) {
  WayOut out(cores), axes(cores);
  if (options.solver == Solver::mpr) {
    ask_mpr(out, couple, options);
    out.least = out.width;
    if (out.method != Method::none) return out;
    out.least = out.floor;
  }
  ask_axes(axes, couple, cores);
  if (options.solver == Solver::gjk) {
    ask_gjk(out, couple, options);
    out.check_claim(couple, axes.width);
    if (out.method != Method::none) return out;
  }
  if (axes_suffice(couple)) {
    axes.least = axes.width;
    return axes;
  }
  ask_polytope(axes, couple, options);
  if (!axes.is_least(couple)) shorten(axes, couple, options);
  return axes;
}

/// Sets the two deepest points: closest points once B has been moved out of A.
void set_points(Penetration& result, const Couple& couple, double depth, const Options& options) {
  const Vec& n = result.direction;
  Couple apart = couple;
  const Vec move = clear_of(couple, n, depth);
  apart.b.move(move);
  const CoreDistance cores = core_distance(apart, options.max_iterations);
  result.on_a = couple.to_world(cores.on_a + n * couple.a.rounding());
  result.on_b = couple.to_world(cores.on_b - n * couple.b.rounding() - move);
}

}  // namespace

Penetration penetration(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                        const Options& options) {
  Penetration result;
  const auto couple = make_couple(a, pose_a, b, pose_b, options);
  if (!couple) return result;
  const CoreDistance cores = core_distance(*couple, options.max_iterations, {couple->rounding + couple->noise, -1});
  if (cores.lower > couple->rounding + couple->noise) {
    result.status = Status::ok;
    result.method = Method::cores;
    return result;
  }

  WayOut out(cores);
  if (!cores.overlap) {
    out.offer(*couple, cores.direction, Method::cores);
    out.limit = cores.limit;
  }
  // Cores that all but touch, too: the plane between them is as uncertain as the distance is short.
  if (cores.overlap || !out.is_least(*couple)) {
    out = way_out(*couple, cores, options);
    out.limit |= cores.limit;
  }
  if (out.method == Method::none) return result;  // not reached: the axes of A are always offered
  if (-out.width > couple->rounding + couple->noise) {
    // The iterations ended before a direction was found in which they lie apart, and another solver met one.
    result.status = Status::ok;
    result.method = out.method;
    return result;
  }
  const double depth = std::max(0.0, out.width + couple->rounding);
  result.intersects = true;
  result.method = out.method;
  result.direction = out.direction;
  result.depth = depth / couple->scale;
  result.status = out.is_least(*couple) ? Status::ok : out.limit ? Status::iteration_limit : Status::inexact;
  set_points(result, *couple, depth, options);
  return result;
}

}  // namespace boxstream::ccd
