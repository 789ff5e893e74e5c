// SPDX-License-Identifier: MIT
// FCL in double, as its users call it: a request with a solver and a tolerance. Iteration limits are no part of a
// request.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <sstream>
#include <stdexcept>

#include "engine.hpp"
#include "fcl_shapes.hpp"

namespace boxstream::report::narrow {
namespace {

using Object = ::fcl::CollisionObject<double>;

/// The words of a solver's name.
struct Wish {
  ::fcl::GJKSolverType solver = ::fcl::GST_LIBCCD;
  bool by_signed_distance = false;  ///< "signed": depths are negative distances, not those of contacts
  bool magnitude = false;           ///< "magnitude": of depths, whatever their sign
  bool mesh_a = false;              ///< "mesh": the first shape is one
  bool mesh_b = false;              ///< "meshes": both are
  FclMeshing meshing;               ///< "hull", "halfway"
};

Wish wish_of(const std::string& solver) {
  Wish wish;
  std::istringstream words(solver);
  std::string word;
  words >> word;
  if (word == "indep")
    wish.solver = ::fcl::GST_INDEP;
  else if (word != "libccd")
    throw std::invalid_argument("FCL has no solver \"" + word + "\"; there are libccd, indep");
  while (words >> word) {
    if (word == "signed")
      wish.by_signed_distance = true;
    else if (word == "magnitude")
      wish.magnitude = true;
    else if (word == "mesh" || word == "meshes")
      wish.mesh_a = true, wish.mesh_b = word == "meshes";
    else if (word == "hull")
      wish.mesh_a = wish.meshing.as_hull = true;
    else if (word == "halfway")
      wish.meshing.halfway = true;
    else
      throw std::invalid_argument(
          "\"" + word + "\" behind a solver of FCL is none of signed, magnitude, mesh, meshes, hull, halfway");
  }
  return wish;
}

Object object_of(const RoundedBox& solid, bool is_mesh, const FclMeshing& meshing) {
  return Object(is_mesh ? mesh_shape(solid, meshing) : exact_shape(solid), solid.rotation, solid.centre);
}

class Fcl : public Engine {
 public:
  Fcl(Wish wish, Query query, const Tuning& tuning, std::span<const Pose> poses) : query_(query), wish_(wish) {
    wish_.meshing.triangles = tuning.triangles;
    distance_.gjk_solver_type = collision_.gjk_solver_type = wish_.solver;
    distance_.enable_signed_distance = wish_.by_signed_distance;
    collision_.enable_contact = query == Query::depth;
    // More than one, since a flat contact has several and the deepest is asked for.
    collision_.num_max_contacts = query == Query::depth ? 8 : 1;
    if (!std::isnan(tuning.tolerance)) distance_.distance_tolerance = collision_.gjk_tolerance = tuning.tolerance;
    for (const Pose& pose : poses)
      pairs_.push_back(
          {object_of(pose.a, wish_.mesh_a, wish_.meshing), object_of(pose.b, wish_.mesh_b, wish_.meshing)});
  }

  double ask(std::size_t pose) override {
    const auto& [a, b] = pairs_[pose];
    return query_ == Query::distance || wish_.by_signed_distance ? distance(a, b) : contact(a, b);
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
    return wish_.magnitude ? -std::abs(deepest) : -deepest;
  }

  Query query_;
  Wish wish_;
  ::fcl::DistanceRequest<double> distance_;
  ::fcl::CollisionRequest<double> collision_;
  std::vector<std::pair<Object, Object>> pairs_;
};

}  // namespace

FclShape exact_shape(const RoundedBox& solid) {
  if (solid.margin == 0) return std::make_shared<::fcl::Box<double>>(2 * solid.half);
  if (solid.half.z() > 0) return std::make_shared<::fcl::Capsule<double>>(solid.margin, 2 * solid.half.z());
  return std::make_shared<::fcl::Sphere<double>>(solid.margin);
}

std::unique_ptr<Engine> make_fcl(const std::string& solver, Query query, const Tuning& tuning,
                                 std::span<const Pose> poses) {
  return std::make_unique<Fcl>(wish_of(solver), query, tuning, poses);
}

}  // namespace boxstream::report::narrow
