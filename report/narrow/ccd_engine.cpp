// SPDX-License-Identifier: MIT
#include <boxstream/ccd.hpp>
#include <cmath>
#include <stdexcept>

#include "engine.hpp"
#include "in_child.hpp"

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

class Ccd : public Engine {
 public:
  Ccd(Query query, const ccd::Options& options, std::span<const Pose> poses) : query_(query), options_(options) {
    for (const Pose& pose : poses)
      pairs_.push_back({shape_of(pose.a), shape_of(pose.b), ccd::Pose(pose.a.rotation, pose.a.centre),
                        ccd::Pose(pose.b.rotation, pose.b.centre)});
  }

  double ask(std::size_t pose) override {
    const Pair& pair = pairs_[pose];
    if (query_ == Query::distance) {
      const ccd::Distance answer = ccd::distance(pair.a, pair.pose_a, pair.b, pair.pose_b, options_);
      require_sure(answer.status);
      return answer.distance;
    }
    if (query_ == Query::depth) {
      const ccd::Penetration answer = ccd::penetration(pair.a, pair.pose_a, pair.b, pair.pose_b, options_);
      require_sure(answer.status);
      return answer.intersects ? -answer.depth : std::nan("");
    }
    const ccd::Intersection answer = ccd::intersect(pair.a, pair.pose_a, pair.b, pair.pose_b, options_);
    require_sure(answer.status);
    return answer.intersects ? -1 : 1;
  }

 private:
  struct Pair {
    ccd::Shape a, b;
    ccd::Pose pose_a, pose_b;
  };
  Query query_;
  ccd::Options options_;
  std::vector<Pair> pairs_;
};

}  // namespace

std::unique_ptr<Engine> make_ccd(const std::string& solver, Query query, const Tuning& tuning,
                                 std::span<const Pose> poses) {
  ccd::Options options;
  if (solver == "gjk")
    options.solver = ccd::Options::Solver::gjk;
  else if (solver == "mpr")
    options.solver = ccd::Options::Solver::mpr;
  else if (!solver.empty())
    throw std::invalid_argument("ccd has no solver \"" + solver + "\"; there are gjk, mpr, or none for automatic");
  if (!std::isnan(tuning.tolerance)) options.tolerance = tuning.tolerance;
  if (tuning.iterations > 0) options.max_iterations = tuning.iterations;
  return std::make_unique<Ccd>(query, options, poses);
}

}  // namespace boxstream::report::narrow
