// SPDX-License-Identifier: MIT
// FCL in double, as its users call it: a request with a solver and a tolerance. Iteration limits are no part of a
// request.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <stdexcept>

#include "engine.hpp"

namespace boxstream::report::narrow {
namespace {

using Object = ::fcl::CollisionObject<double>;

Object object_of(const RoundedBox& solid) {
  std::shared_ptr<::fcl::CollisionGeometry<double>> shape;
  if (solid.margin == 0)
    shape = std::make_shared<::fcl::Box<double>>(2 * solid.half);
  else if (solid.half.z() > 0)
    shape = std::make_shared<::fcl::Capsule<double>>(solid.margin, 2 * solid.half.z());
  else
    shape = std::make_shared<::fcl::Sphere<double>>(solid.margin);
  return Object(shape, solid.rotation, solid.centre);
}

class Fcl : public Engine {
 public:
  /// `by_signed_distance`: depths are negative distances, not those of contacts.
  Fcl(::fcl::GJKSolverType solver, bool by_signed_distance, Query query, const Tuning& tuning,
      std::span<const Pose> poses)
      : query_(query), by_signed_distance_(by_signed_distance) {
    distance_.gjk_solver_type = collision_.gjk_solver_type = solver;
    distance_.enable_signed_distance = by_signed_distance;
    collision_.enable_contact = query == Query::depth;
    // More than one, since a flat contact has several and the deepest is asked for.
    collision_.num_max_contacts = query == Query::depth ? 8 : 1;
    if (!std::isnan(tuning.tolerance)) distance_.distance_tolerance = collision_.gjk_tolerance = tuning.tolerance;
    for (const Pose& pose : poses) pairs_.push_back({object_of(pose.a), object_of(pose.b)});
  }

  double ask(std::size_t pose) override {
    const auto& [a, b] = pairs_[pose];
    return query_ == Query::distance || by_signed_distance_ ? distance(a, b) : contact(a, b);
  }

 private:
  double distance(const Object& a, const Object& b) const {
    ::fcl::DistanceResult<double> result;
    ::fcl::distance(&a, &b, distance_, result);
    return result.min_distance;
  }

  double contact(const Object& a, const Object& b) const {
    ::fcl::CollisionResult<double> result;
    ::fcl::collide(&a, &b, collision_, result);
    if (query_ == Query::verdict) return result.isCollision() ? -1 : 1;
    double deepest = std::nan("");
    for (std::size_t i = 0; i < result.numContacts(); ++i)
      deepest = std::fmax(deepest, result.getContact(i).penetration_depth);
    return -deepest;
  }

  Query query_;
  bool by_signed_distance_;
  ::fcl::DistanceRequest<double> distance_;
  ::fcl::CollisionRequest<double> collision_;
  std::vector<std::pair<Object, Object>> pairs_;
};

}  // namespace

std::unique_ptr<Engine> make_fcl(const std::string& solver, Query query, const Tuning& tuning,
                                 std::span<const Pose> poses) {
  const bool is_signed = solver.ends_with(" signed");
  const std::string name = solver.substr(0, solver.find(' '));
  if (name != "libccd" && name != "indep")
    throw std::invalid_argument("FCL has no solver \"" + solver + "\"; there are libccd, indep, and \"signed\" behind");
  const auto type = name == "libccd" ? ::fcl::GST_LIBCCD : ::fcl::GST_INDEP;
  return std::make_unique<Fcl>(type, is_signed, query, tuning, poses);
}

}  // namespace boxstream::report::narrow
