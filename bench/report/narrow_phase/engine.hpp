// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "narrow_phase/pose.hpp"

namespace boxstream::report::narrow {

enum class Query {
  distance,  ///< of shapes that are apart
  depth,     ///< of shapes that overlap
  verdict    ///< whether they touch
};

/// The knobs of narrow phases; those that an engine does not have are left alone.
struct Tuning {
  double tolerance = std::numeric_limits<double>::quiet_NaN();  ///< NaN: the engine's own default
  int iterations = 0;                                           ///< 0: the engine's own default
  double margin = std::numeric_limits<double>::quiet_NaN();     ///< of Bullet's boxes, in metres
  int triangles = 0;                                            ///< of meshes
};

/// A narrow phase with the shapes of all poses made; called with the index of a pose.
///
/// Distance: its result, 0 or below for touching. Depth: minus the depth; NaN if it finds no contact. Verdict: -1 for
/// touching, 1 for apart. Throws what the narrow phase throws, and Unsure if that reports failure. May abort, and may
/// not end: call it in a child process first.
using Engine = std::function<double(std::size_t pose)>;

/// A library and a solver of it: "ccd", "ccd gjk", "ccd mpr", "libccd gjk", "libccd mpr", "fcl libccd" or "fcl indep"
/// with "signed", "magnitude", "mesh", "meshes", "hull", "halfway" behind, "fcl_float libccd", "fcl_float indep",
/// "bullet dispatcher", "bullet epa" or "bullet minkowski" with "hulls" behind. Throws std::invalid_argument for a name
/// or a query that it does not know. Keeps the poses' span.
Engine make_engine(const std::string& name, Query query, const Tuning& tuning, std::span<const Pose> poses);

Engine make_fcl(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses);
Engine make_fcl_float(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses);
Engine make_ccd(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses);
Engine make_bullet(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses);
Engine make_libccd(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses);

}  // namespace boxstream::report::narrow
