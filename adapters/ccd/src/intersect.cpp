// SPDX-License-Identifier: MIT
#include "core_distance.hpp"
#include "libccd.hpp"

namespace boxstream::ccd {
namespace {

using Solver = Options::Solver;

Vec any_direction(const ShapePair& pair) {
  const Vec between = pair.b.centre() - pair.a.centre();
  return between.squaredNorm() > 0 ? between : Vec(Vec::UnitX());
}

/// libccd reports "disjoint" for failures too: the answer counts only with a separating plane.
std::optional<bool> verdict(const LibccdAnswer& answer, const ShapePair& pair) {
  if (answer.limit || answer.degenerate) return std::nullopt;
  if (answer.hit) return true;
  if (answer.gap > pair.noise) return false;
  return std::nullopt;
}

Intersection try_cores(const ShapePair& pair, const Options& options) {
  const Goal goal{pair.rounding + pair.noise, pair.rounding + pair.tolerance};
  const CoreDistance cores = core_distance(pair, options.max_iterations, goal);
  if (cores.upper <= goal.close_enough) return {Status::ok, true, Method::cores};
  if (cores.lower > goal.enough_apart) return {Status::ok, false, Method::cores};
  return {cores.limit ? Status::iteration_limit : Status::inexact, true, Method::cores};
}

}  // namespace

Intersection intersect(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, const Options& options) {
  const auto pair = make_shape_pair(a, pose_a, b, pose_b, options);
  if (!pair) return {};
  const bool by_gjk = options.solver == Solver::gjk;
  LibccdCall call(*pair, LibccdCall::Of::shapes, options.max_iterations, any_direction(*pair));
  const LibccdAnswer answer = by_gjk ? call.gjk() : call.mpr();
  const Method method = by_gjk ? Method::gjk : Method::mpr;
  if (const auto hit = verdict(answer, *pair)) return {Status::ok, *hit, method};
  if (options.solver == Solver::automatic) return try_cores(*pair, options);
  return {answer.limit ? Status::iteration_limit : Status::inexact, true, method};
}

}  // namespace boxstream::ccd
