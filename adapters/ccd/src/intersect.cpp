// SPDX-License-Identifier: MIT
#include "core_distance.hpp"
#include "libccd.hpp"

namespace boxstream::ccd {
namespace {

using Solver = Options::Solver;

Vec any_direction(const Couple& couple) {
  const Vec between = couple.b.centre() - couple.a.centre();
  return between.squaredNorm() > 0 ? between : Vec(Vec::UnitX());
}

/// libccd says "apart" for "I do not know" too: without a plane between the shapes that is no answer.
std::optional<bool> verdict(const LibccdAnswer& answer, const Couple& couple) {
  if (answer.limit || answer.degenerate) return std::nullopt;
  if (answer.hit) return true;
  if (answer.gap > couple.noise) return false;
  return std::nullopt;
}

Intersection ask_cores(const Couple& couple, const Options& options) {
  const Goal goal{couple.rounding + couple.noise, couple.rounding + couple.tolerance};
  const CoreDistance cores = core_distance(couple, options.max_iterations, goal);
  if (cores.upper <= goal.close_enough) return {Status::ok, true, Method::cores};
  if (cores.lower > goal.enough_apart) return {Status::ok, false, Method::cores};
  return {cores.limit ? Status::iteration_limit : Status::inexact, true, Method::cores};
}

}  // namespace

Intersection intersect(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, const Options& options) {
  const auto couple = make_couple(a, pose_a, b, pose_b, options);
  if (!couple) return {};
  const bool by_gjk = options.solver == Solver::gjk;
  LibccdCall call(*couple, LibccdCall::Of::shapes, options.max_iterations, any_direction(*couple));
  const LibccdAnswer answer = by_gjk ? call.gjk() : call.mpr();
  const Method method = by_gjk ? Method::gjk : Method::mpr;
  if (const auto hit = verdict(answer, *couple)) return {Status::ok, *hit, method};
  if (options.solver == Solver::automatic) return ask_cores(*couple, options);
  return {answer.limit ? Status::iteration_limit : Status::inexact, true, method};
}

}  // namespace boxstream::ccd
