// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

/// Pairs of shapes that narrow phases are known to fail on: poses.json.
namespace boxstream::poses {

enum class Kind { box, sphere, capsule, cylinder, cone, hull, half_space, mesh_box, cells };

/// One shape where it is: x -> rotation * x + translation. A mesh_box is a box made of triangles, cells are the
/// occupied cells of an octree.
struct Solid {
  Kind kind = Kind::box;
  std::array<double, 4> size{};         ///< sides; or radius and height; or normal and offset; or the side of a cell
  std::vector<Eigen::Vector3d> points;  ///< corners of boxes and hulls, centres of cells
  std::vector<std::vector<int>> faces;  ///< of boxes and hulls: corners, counter-clockwise from outside
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
};

enum class Query { distance, signed_distance, contact };

/// What FCL 0.7.0 of Debian 12 is known to answer.
struct Known {
  std::string outcome;  ///< "right", "wrong", "throws", "aborts" ...: see outcome.hpp
  double value = 0;     ///< signed distance, or minus the depth; only if it is right or wrong
};

struct HardPose {
  std::string name;
  int row = 0;         ///< poses that belong together
  std::string source;  ///< thread that tells of it: "fcl#508"
  std::string own;     ///< why the numbers are not the published ones; empty if they are
  Query query = Query::distance;
  Solid a, b;
  double truth = 0;   ///< signed distance, up to rounding: negative is the depth
  std::string known;  ///< how the truth is known
  Known libccd, indep;
};

/// All of poses.json, in its order. Throws std::runtime_error "FILE: /json/pointer: reason".
std::vector<HardPose> load(const std::string& file);
/// The same, of the file that is beside the tests, read once.
const std::vector<HardPose>& all();

/// What a solid is made of if it is not convex, or the solid itself: boxes in place of cells and of a mesh_box.
std::vector<Solid> parts(const Solid& solid);

/// "box 1 x 1 x 1", "hull of 8".
std::string text(const Solid& solid);

}  // namespace boxstream::poses
