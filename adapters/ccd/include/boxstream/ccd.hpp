// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boxstream/aabb.hpp>
#include <boxstream/detail/export.hpp>
#include <cstdint>
#include <variant>
#include <vector>

/// A narrow phase for convex shapes on libccd, for worlds without an engine: intersection, penetration depth, distance.
/// Known failures of libccd are detected and answered by another solver or by a status: docs/narrow_phase.md. Nothing
/// is kept between calls. There are no meshes (give their convex parts), no motion and no contact patches.
namespace boxstream::ccd {

// Sizes are finite and not negative; zero is legal (a point, a segment, a flat box). Round shapes lie along local z and
// are centred on the origin, as FCL's are.

/// A box centred on the origin.
struct Box {
  Eigen::Vector3d half_extents;
};
/// A ball around the origin.
struct Sphere {
  double radius;
};
/// `height` is between the centres of the two end spheres.
struct Capsule {
  double radius;
  double height;
};
/// `height` is between the two flat ends.
struct Cylinder {
  double radius;
  double height;
};
/// The apex is at z = height / 2.
struct Cone {
  double radius;
  double height;
};
/// The convex hull of at least one point. Coplanar points, duplicates and points inside are legal. Each step of a
/// solver reads all points, so leave interior points out of big hulls. Points may be far from the local origin.
struct ConvexHull {
  std::vector<Eigen::Vector3d> points;
};

using Shape = std::variant<Box, Sphere, Capsule, Cylinder, Cone, ConvexHull>;

/// Where a shape is: x -> rotation * x + translation. Unlike Eigen's Isometry3d it needs no alignment, so that its
/// layout does not depend on compiler flags.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Pose() = default;
  Pose(const Eigen::Matrix3d& turn, const Eigen::Vector3d& place) : rotation(turn), translation(place) {}
  /// From Eigen's transforms of either precision: Isometry3d, Affine3f, fcl::Transform3d ...
  template <class S, int Mode, int Options>
  Pose(const Eigen::Transform<S, 3, Mode, Options>& t)  // NOLINT(google-explicit-constructor)
      : rotation(t.linear().template cast<double>()), translation(t.translation().template cast<double>()) {}
};

/// How far an answer can be relied on. There is never a NaN in one.
enum class Status : std::uint8_t {
  ok,               ///< within the tolerance
  inexact,          ///< the limit of precision came before the tolerance; see the bounds in each result
  iteration_limit,  ///< `Options::max_iterations` was reached; the bounds hold, more iterations may tighten them
  invalid_input,    ///< NaN, infinite, a negative size, a hull without points, a pose whose matrix is no rotation
};

/// The method that found the answer.
enum class Method : std::uint8_t {
  none,
  cores,  ///< the distance between the shapes without their rounding: a sphere is a point, a capsule a segment
  gjk,    ///< libccd's GJK
  epa,    ///< an expanding polytope (libccd's with Solver::gjk), and a local search from its best directions
  mpr,    ///< libccd's MPR
  axes,   ///< a direction from face normals, edges or axes of the shapes, since no solver had a better one
};

/// Tolerance, limits and method.
struct Options {
  /// Largest error of distances and depths, as a fraction of the size of the smaller shape (the radius of a sphere
  /// around its own middle; the larger one's if the smaller is a point). Rounding adds 3e-14 of the largest length that
  /// enters: the sizes, the distance of the two poses, and that of a hull's points from their origin. Where both poses
  /// are does not matter. Smaller takes longer, mainly where curved surfaces penetrate. Above 0.
  double tolerance = 1e-6;
  /// Limit of the support points of one solver. A call runs up to twenty solvers, mostly one. Deep contacts of curved
  /// surfaces need 125.
  int max_iterations = 500;
  /// The method that is tried first: `automatic`, or libccd's GJK (with EPA) or MPR for experiments. Answers are always
  /// checked. Other methods run after a failed check if this is `automatic`, or if there is no direction.
  enum class Solver : std::uint8_t { automatic, gjk, mpr } solver = Solver::automatic;
};

/// Whether two shapes share a point.
struct Intersection {
  Status status = Status::invalid_input;
  /// True for shapes that share a point (touching counts), false for a gap above the tolerance; smaller gaps may give
  /// either. With status `inexact` or `iteration_limit`: undecided, and true.
  bool intersects = false;
  Method method = Method::none;
};

/// How deep two shapes lie in each other.
struct Penetration {
  Status status = Status::invalid_input;
  bool intersects = false;  ///< as above; everything below is zero if false
  /// How far B must move along `direction` until the shapes only touch: right for this direction whatever the status,
  /// and with status `ok` the least over all directions within the tolerance (not so with Solver::mpr, which does not
  /// look for the least).
  double depth = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit length, from A to B
  /// With status `ok` the deepest point of A in B and of B in A, `depth` apart; one of many pairs on flat contacts.
  Eigen::Vector3d on_a = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
  Method method = Method::none;
};

/// How far two shapes are apart.
struct Distance {
  Status status = Status::invalid_input;
  /// 0 for shapes that touch or overlap. Never below the true distance by more than rounding: the distance of two
  /// points of the shapes.
  double distance = 0;
  double lower_bound = 0;  ///< the true distance is not below this
  Eigen::Vector3d on_a =
      Eigen::Vector3d::Zero();  ///< closest points; a common point, up to the tolerance, at distance 0
  Eigen::Vector3d on_b = Eigen::Vector3d::Zero();
};

/// The box of a shape in its pose: it contains the shape, rounding included, and is larger by a few units in the last
/// place only. For invalid input a box that pairs with nothing (min > max).
BOXSTREAM_API Aabb64 bounds(const Shape& shape, const Pose& pose);

// Thread-safe. Only polytopes of deep contacts allocate memory.

BOXSTREAM_API Intersection intersect(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                     const Options& options = {});
BOXSTREAM_API Penetration penetration(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                      const Options& options = {});
/// By a GJK of this library over the same support functions: libccd has no distance.
BOXSTREAM_API Distance distance(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                const Options& options = {});

/// Size in bytes of libccd's real number (Debian: 8). The functions above throw std::runtime_error
/// if the linked libccd has another precision than its headers.
BOXSTREAM_API std::size_t real_size();

/// "ok", "inexact", "iteration limit", "invalid input"; "none", "cores", "gjk", "epa", "mpr", "axes".
BOXSTREAM_API const char* name(Status status);
BOXSTREAM_API const char* name(Method method);

}  // namespace boxstream::ccd
