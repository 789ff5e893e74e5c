// SPDX-License-Identifier: MIT
#include <boxstream/ccd.hpp>
#include <cmath>
#include <stdexcept>

#include "narrow_phase/engine.hpp"
#include "narrow_phase/in_child.hpp"

namespace boxstream::report::narrow {
namespace {

ccd::Shape shape_of(const RoundedBox& solid) {
  if (solid.margin == 0) return ccd::Box{solid.half};
  if (solid.half.z() > 0) return ccd::Capsule{solid.margin, 2 * solid.half.z()};
  return ccd::Sphere{solid.margin};
}

void require_sure(ccd::Status status) {
  if (status != ccd::Status::ok) throw Unsure(ccd::name(status));
}

struct Pair {
  ccd::Shape a, b;
  ccd::Pose pose_a, pose_b;
};

double ask(Query query, const Pair& pair, const ccd::Options& options) {
  if (query == Query::distance) {
    const ccd::Distance answer = ccd::distance(pair.a, pair.pose_a, pair.b, pair.pose_b, options);
    require_sure(answer.status);
    return answer.distance;
  }
  if (query == Query::depth) {
    const ccd::Penetration answer = ccd::penetration(pair.a, pair.pose_a, pair.b, pair.pose_b, options);
    require_sure(answer.status);
    return answer.intersects ? -answer.depth : std::nan("");
  }
  const ccd::Intersection answer = ccd::intersect(pair.a, pair.pose_a, pair.b, pair.pose_b, options);
  require_sure(answer.status);
  return answer.intersects ? -1 : 1;
}

}  // namespace

Engine make_ccd(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses) {
  ccd::Options options;
  if (solver == "gjk")
    options.solver = ccd::Options::Solver::gjk;
  else if (solver == "mpr")
    options.solver = ccd::Options::Solver::mpr;
  else if (!solver.empty())
    throw std::invalid_argument("ccd has no solver \"" + solver + "\"; there are gjk, mpr, or none for automatic");
  if (!std::isnan(tuning.tolerance)) options.tolerance = tuning.tolerance;
  if (tuning.iterations > 0) options.max_iterations = tuning.iterations;
  std::vector<Pair> pairs;
  for (const Pose& pose : poses)
    pairs.push_back({shape_of(pose.a), shape_of(pose.b), ccd::Pose(pose.a.rotation, pose.a.centre),
                     ccd::Pose(pose.b.rotation, pose.b.centre)});
  return [=](std::size_t pose) { return ask(query, pairs[pose], options); };
}

}  // namespace boxstream::report::narrow
