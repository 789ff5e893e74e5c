// SPDX-License-Identifier: MIT
// FCL's solvers in float. Its entry points are compiled for double alone, so these are the solvers' own, for the pairs
// of shapes in the experiments.
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/detail/gjk_solver_indep.h>
#include <fcl/narrowphase/detail/gjk_solver_libccd.h>

#include <cmath>
#include <stdexcept>
#include <variant>

#include "narrow_phase/engine.hpp"

namespace boxstream::report::narrow {
namespace {

using Shape = std::variant<::fcl::Box<float>, ::fcl::Sphere<float>, ::fcl::Capsule<float>>;

Shape shape_of(const RoundedBox& solid) {
  const auto radius = static_cast<float>(solid.margin), height = static_cast<float>(2 * solid.half.z());
  if (solid.margin == 0) return ::fcl::Box<float>((2 * solid.half).cast<float>());
  if (height > 0) return ::fcl::Capsule<float>(radius, height);
  return ::fcl::Sphere<float>(radius);
}

::fcl::Transform3<float> place_of(const RoundedBox& solid) {
  ::fcl::Transform3<float> place = ::fcl::Transform3<float>::Identity();
  place.linear() = solid.rotation.cast<float>();
  place.translation() = solid.centre.cast<float>();
  return place;
}

struct Pair {
  Shape a, b;
  ::fcl::Transform3<float> at_a, at_b;
};

void set_tolerance(::fcl::detail::GJKSolver_libccd<float>& solver, float tolerance) {
  solver.distance_tolerance = solver.collision_tolerance = tolerance;
}

void set_tolerance(::fcl::detail::GJKSolver_indep<float>& solver, float tolerance) {
  solver.gjk_tolerance = solver.epa_tolerance = tolerance;
}

template <class Solver, class A, class B>
double ask(Query query, const Solver& solver, const A& a, const ::fcl::Transform3<float>& at_a, const B& b,
           const ::fcl::Transform3<float>& at_b) {
  if (query == Query::distance) {
    float distance = 0;
    // Its formula for two capsules writes the points even where they are not wanted.
    ::fcl::Vector3<float> on_a, on_b;
    solver.shapeDistance(a, at_a, b, at_b, &distance, &on_a, &on_b);
    return static_cast<double>(distance);
  }
  if (query == Query::verdict) return solver.shapeIntersect(a, at_a, b, at_b, nullptr) ? -1 : 1;
  std::vector<::fcl::ContactPoint<float>> contacts;
  solver.shapeIntersect(a, at_a, b, at_b, &contacts);
  double deepest = std::nan("");
  for (const auto& contact : contacts) deepest = std::fmax(deepest, static_cast<double>(contact.penetration_depth));
  return -deepest;
}

template <class Solver>
Engine make(Solver solver, Query query, const Tuning& tuning, std::span<const Pose> poses) {
  if (!std::isnan(tuning.tolerance)) set_tolerance(solver, static_cast<float>(tuning.tolerance));
  std::vector<Pair> pairs;
  for (const Pose& pose : poses)
    pairs.push_back({shape_of(pose.a), shape_of(pose.b), place_of(pose.a), place_of(pose.b)});
  return [=](std::size_t pose) {
    const Pair& pair = pairs[pose];
    return std::visit([&](const auto& a, const auto& b) { return ask(query, solver, a, pair.at_a, b, pair.at_b); },
                      pair.a, pair.b);
  };
}

}  // namespace

Engine make_fcl_float(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses) {
  if (solver == "libccd") return make(::fcl::detail::GJKSolver_libccd<float>(), query, tuning, poses);
  if (solver == "indep") return make(::fcl::detail::GJKSolver_indep<float>(), query, tuning, poses);
  throw std::invalid_argument("FCL in float has no solver \"" + solver + "\"; there are libccd, indep");
}

}  // namespace boxstream::report::narrow
