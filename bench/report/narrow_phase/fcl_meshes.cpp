// SPDX-License-Identifier: MIT
// Round shapes as FCL has them without a formula: triangles in a tree of boxes, or a hull.
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/math/bv/OBBRSS.h>

#include <map>
#include <stdexcept>
#include <tuple>

#include "narrow_phase/fcl_shapes.hpp"
#include "narrow_phase/round_mesh.hpp"

namespace boxstream::report::narrow {
namespace {

/// Of a sphere or a capsule: the two halves of a capsule's sphere are moved apart, and the triangles between them
/// become its sides.
std::vector<Eigen::Vector3d> points_of(const Mesh& mesh, const RoundedBox& solid, double scale) {
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& p : mesh.points)
    points.push_back(scale * solid.margin * p + Eigen::Vector3d(0, 0, p.z() < 0 ? -solid.half.z() : solid.half.z()));
  return points;
}

FclShape tree_of(const Mesh& mesh, const std::vector<Eigen::Vector3d>& points) {
  std::vector<::fcl::Triangle> triangles;
  for (const auto& [i, j, k] : mesh.triangles)
    triangles.emplace_back(static_cast<std::size_t>(i), static_cast<std::size_t>(j), static_cast<std::size_t>(k));
  const auto model = std::make_shared<::fcl::BVHModel<::fcl::OBBRSS<double>>>();
  model->beginModel();
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

FclShape hull_of(const Mesh& mesh, const std::vector<Eigen::Vector3d>& points) {
  const auto faces = std::make_shared<std::vector<int>>();
  for (const auto& [i, j, k] : mesh.triangles) faces->insert(faces->end(), {3, i, j, k});
  const auto corners = std::make_shared<std::vector<Eigen::Vector3d>>(points);
  return std::make_shared<::fcl::Convex<double>>(corners, static_cast<int>(mesh.triangles.size()), faces);
}

}  // namespace

FclShape mesh_shape(const RoundedBox& solid, const FclMeshing& meshing) {
  if (solid.margin == 0) return exact_shape(solid);
  if (meshing.as_hull && solid.half.z() > 0)
    throw std::invalid_argument("a capsule's mesh is a little dented, so it is no hull");
  // Every pose has the same mesh, and building its tree takes longer than all queries.
  using Key = std::tuple<double, double, int, bool, bool>;
  static std::map<Key, std::weak_ptr<::fcl::CollisionGeometry<double>>> made;
  std::weak_ptr<::fcl::CollisionGeometry<double>>& known =
      made[{solid.margin, solid.half.z(), meshing.triangles, meshing.as_hull, meshing.halfway}];
  if (FclShape shape = known.lock()) return shape;
  const Mesh mesh = sphere_mesh(meshing.triangles);
  const auto points = points_of(mesh, solid, meshing.halfway ? 2 / (1 + inner_radius(mesh)) : 1);
  const FclShape shape = meshing.as_hull ? hull_of(mesh, points) : tree_of(mesh, points);
  known = shape;
  return shape;
}

}  // namespace boxstream::report::narrow
