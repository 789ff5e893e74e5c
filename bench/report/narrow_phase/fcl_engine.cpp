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

#include "narrow_phase/engine.hpp"
#include "narrow_phase/fcl_shapes.hpp"

namespace boxstream::report::narrow {
namespace {

using Object = ::fcl::CollisionObject<double>;

/// The words of a solver's name.
struct Options {
  ::fcl::GJKSolverType solver = ::fcl::GST_LIBCCD;
  bool by_signed_distance = false;  ///< "signed": depths are negative distances, not those of contacts
  bool magnitude = false;           ///< "magnitude": of depths, whatever their sign
  bool mesh_a = false;              ///< "mesh": the first shape is one
  bool mesh_b = false;              ///< "meshes": both are
  FclMeshing meshing;               ///< "hull", "halfway"
};

Options options_of(const std::string& solver) {
  Options options;
  std::istringstream words(solver);
  std::string word;
  words >> word;
  if (word == "indep")
    options.solver = ::fcl::GST_INDEP;
  else if (word != "libccd")
    throw std::invalid_argument("FCL has no solver \"" + word + "\"; there are libccd, indep");
  while (words >> word) {
    if (word == "signed")
      options.by_signed_distance = true;
    else if (word == "magnitude")
      options.magnitude = true;
    else if (word == "mesh" || word == "meshes")
      options.mesh_a = true, options.mesh_b = word == "meshes";
    else if (word == "hull")
      options.mesh_a = options.meshing.as_hull = true;
    else if (word == "halfway")
      options.meshing.halfway = true;
    else
      throw std::invalid_argument(
          "\"" + word + "\" behind a solver of FCL is none of signed, magnitude, mesh, meshes, hull, halfway");
  }
  return options;
}

Object object_of(const RoundedBox& solid, bool is_mesh, const FclMeshing& meshing) {
  return Object(is_mesh ? mesh_shape(solid, meshing) : exact_shape(solid), solid.rotation, solid.centre);
}

struct Fcl {
  double distance(const Object& a, const Object& b) const {
    ::fcl::DistanceResult<double> result;
    ::fcl::distance(&a, &b, distance_request, result);
    return result.min_distance;
  }

  double contact(const Object& a, const Object& b) const {
    ::fcl::CollisionResult<double> result;
    ::fcl::collide(&a, &b, collision_request, result);
    if (query == Query::verdict) return result.isCollision() ? -1 : 1;
    double deepest = std::nan("");
    for (std::size_t i = 0; i < result.numContacts(); ++i)
      deepest = std::fmax(deepest, result.getContact(i).penetration_depth);
    return options.magnitude ? -std::abs(deepest) : -deepest;
  }

  Query query;
  Options options;
  ::fcl::DistanceRequest<double> distance_request{};
  ::fcl::CollisionRequest<double> collision_request{};
  std::vector<std::pair<Object, Object>> pairs{};
};

}  // namespace

FclShape exact_shape(const RoundedBox& solid) {
  if (solid.margin == 0) return std::make_shared<::fcl::Box<double>>(2 * solid.half);
  if (solid.half.z() > 0) return std::make_shared<::fcl::Capsule<double>>(solid.margin, 2 * solid.half.z());
  return std::make_shared<::fcl::Sphere<double>>(solid.margin);
}

Engine make_fcl(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses) {
  Fcl fcl{query, options_of(solver)};
  fcl.options.meshing.triangles = tuning.triangles;
  fcl.distance_request.gjk_solver_type = fcl.collision_request.gjk_solver_type = fcl.options.solver;
  fcl.distance_request.enable_signed_distance = fcl.options.by_signed_distance;
  fcl.collision_request.enable_contact = query == Query::depth;
  // More than one, since a flat contact has several, of which the deepest counts.
  fcl.collision_request.num_max_contacts = query == Query::depth ? 8 : 1;
  if (!std::isnan(tuning.tolerance))
    fcl.distance_request.distance_tolerance = fcl.collision_request.gjk_tolerance = tuning.tolerance;
  const Options& options = fcl.options;
  for (const Pose& pose : poses)
    fcl.pairs.push_back(
        {object_of(pose.a, options.mesh_a, options.meshing), object_of(pose.b, options.mesh_b, options.meshing)});
  return [fcl](std::size_t pose) {
    const auto& [a, b] = fcl.pairs[pose];
    return fcl.query == Query::distance || fcl.options.by_signed_distance ? fcl.distance(a, b) : fcl.contact(a, b);
  };
}

}  // namespace boxstream::report::narrow
