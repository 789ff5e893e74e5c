// SPDX-License-Identifier: MIT
#include <algorithm>

#include "core_distance.hpp"

namespace boxstream::ccd {
namespace {

Status status_of(const CoreDistance& cores, double tolerance) {
  if (cores.upper - cores.lower <= tolerance) return Status::ok;
  return cores.limit ? Status::iteration_limit : Status::inexact;
}

}  // namespace

Distance distance(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, const Options& options) {
  Distance result;
  const auto pair = make_shape_pair(a, pose_a, b, pose_b, options);
  if (!pair) return result;
  const CoreDistance cores = core_distance(*pair, options.max_iterations);
  const double round_a = pair->a.rounding(), round_b = pair->b.rounding();
  result.status = status_of(cores, pair->tolerance);
  result.lower_bound = std::max(0.0, cores.lower - pair->rounding) / pair->scale;
  const Vec towards_b = cores.upper > 0 ? Vec((cores.on_b - cores.on_a) / cores.upper) : Vec(Vec::Zero());
  // Both points move outwards to their surfaces, or until they meet.
  const double from_a = std::clamp(cores.upper - round_b, 0.0, round_a);
  const double from_b = std::min(round_b, cores.upper - from_a);
  result.distance = std::max(0.0, cores.upper - pair->rounding) / pair->scale;
  result.on_a = pair->to_world(cores.on_a + towards_b * (result.distance > 0 ? round_a : from_a));
  result.on_b = pair->to_world(cores.on_b - towards_b * (result.distance > 0 ? round_b : from_b));
  return result;
}

}  // namespace boxstream::ccd
