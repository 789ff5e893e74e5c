// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core_distance.hpp"
#include "libccd.hpp"

namespace boxstream::ccd {
namespace {

using Solver = Options::Solver;

/// The shortest way out that is known. Every direction gives a way out whose length is easily computed, so what a
/// solver says of its direction's length need not be believed.
struct WayOut {
  double width = std::numeric_limits<double>::infinity();  ///< of the cores along `direction`
  double least = 0;                                        ///< no way out is shorter, as far as a solver knows
  Vec direction = Vec::Zero();
  Method method = Method::none;
  bool limit = false;

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
    if (least > std::min(width, other_width) + couple.tolerance) least = 0;
    least = std::min(least, width);
  }

  bool is_least(const Couple& couple) const { return width - least <= couple.tolerance; }
};

void offer_both(WayOut& out, const Couple& couple, const Vec& d, Method by) {
  out.offer(couple, d, by);
  out.offer(couple, -d, by);
}

void ask_epa(WayOut& out, const Couple& couple, const Options& options, const Vec& first) {
  LibccdCall call(couple, LibccdCall::Of::cores, options.max_iterations, first);
  const LibccdAnswer answer = call.gjk_penetration();
  out.limit |= answer.limit;
  if (!(answer.direction.squaredNorm() > 0)) return;
  out.offer(couple, answer.direction, Method::epa);
  if (!answer.limit) out.claim_least(couple, answer.depth);
}

void ask_mpr(WayOut& out, const Couple& couple, const Options& options) {
  LibccdCall call(couple, LibccdCall::Of::cores, options.max_iterations, Vec::UnitX());
  const LibccdAnswer answer = call.mpr_penetration();
  out.limit |= answer.limit;
  if (answer.direction.squaredNorm() > 0) out.offer(couple, answer.direction, Method::mpr);
}

/// Directions that need no solver: the last one in which the cores looked apart, normals of what the distance algorithm
/// saw of A - B, the axes of both shapes and what is square to two of them.
void ask_axes(WayOut& out, const Couple& couple, const CoreDistance& cores) {
  offer_both(out, couple, cores.direction, Method::axes);
  const Simplex& s = cores.simplex;
  for (int i = 0; i < s.size; ++i)
    for (int j = i + 1; j < s.size; ++j)
      for (int k = j + 1; k < s.size; ++k)
        offer_both(out, couple, (s[j].w - s[i].w).cross(s[k].w - s[i].w), Method::axes);
  const Eigen::Matrix3d &p = couple.a.rotation(), &q = couple.b.rotation();
  for (int i = 0; i < 3; ++i) {
    offer_both(out, couple, p.col(i), Method::axes);
    offer_both(out, couple, q.col(i), Method::axes);
    for (int j = 0; j < 3; ++j) {
      const Vec square = p.col(i).cross(q.col(j));
      if (square.squaredNorm() > 1e-12) offer_both(out, couple, square, Method::axes);
    }
  }
}

/// The way out of two cores that share a point.
WayOut way_out(const Couple& couple, const CoreDistance& cores, const Options& options) {
  WayOut out;
  if (options.solver == Solver::mpr) {
    ask_mpr(out, couple, options);
    out.least = out.width;
    if (out.method != Method::none) return out;
    out.least = 0;
  }
  // A start that happens to lead through an edge or a corner of A - B makes libccd take a deep contact for a touch, or
  // grow a polytope that is not convex. It is right from one of these starts in all but a few contacts of a thousand.
  static const Vec starts[] = {{0.48, 0.36, 0.8}, {-0.6, 0.64, -0.48}, {0.28, -0.96, 0.1}, {-0.9, -0.3, 0.2},
                               {0.1, 0.2, -0.9},  {0.6, -0.5, -0.5},   {-0.3, 0.1, 0.9}};
  WayOut axes;
  ask_axes(axes, couple, cores);
  for (const Vec& start : starts) {
    ask_epa(out, couple, options, start);
    // Where shapes barely touch, EPA's polytope may lie beside the origin. Then it is sure of a depth that is far too
    // large, which the directions in which the shapes lie apart, or nearly, give away.
    out.check_claim(couple, axes.width);
    if (out.method != Method::none && (out.is_least(couple) || options.solver == Solver::gjk)) return out;
  }
  ask_mpr(out, couple, options);
  out.offer(couple, axes.direction, Method::axes);
  out.check_claim(couple, axes.width);
  return out;
}

/// Sets the two deepest points: closest points once B has been moved out of A, and a little farther so that the shapes
/// are surely apart.
void set_points(Penetration& result, const Couple& couple, double depth, const Options& options) {
  const Vec& n = result.direction;
  Couple apart = couple;
  const double clearance = std::max(1e-3, 16 * couple.tolerance);
  const Vec move = n * (depth + clearance + couple.noise);
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

  WayOut out;
  if (cores.overlap) {
    out = way_out(*couple, cores, options);
  } else {
    out.offer(*couple, cores.direction, Method::cores);
    out.least = -cores.upper;
    out.limit = cores.limit;
    // Curved cores that all but touch: the plane between them is as uncertain as the distance is short.
    if (!out.is_least(*couple)) ask_axes(out, *couple, cores);
  }
  if (out.method == Method::none) return result;  // not reached: the axes of A are always offered
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
