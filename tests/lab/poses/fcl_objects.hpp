// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision_object.h>

#include <memory>

#include "hard_pose.hpp"

namespace boxstream::poses {

template <class S>
std::shared_ptr<::fcl::CollisionGeometry<S>> hull_geometry(const Solid& solid) {
  const auto points = std::make_shared<std::vector<::fcl::Vector3<S>>>();
  for (const Eigen::Vector3d& p : solid.points) points->push_back(p.cast<S>());
  const auto faces = std::make_shared<std::vector<int>>();
  for (const std::vector<int>& face : solid.faces) {
    faces->push_back(static_cast<int>(face.size()));
    faces->insert(faces->end(), face.begin(), face.end());
  }
  return std::make_shared<::fcl::Convex<S>>(points, static_cast<int>(solid.faces.size()), faces);
}

template <class S>
std::shared_ptr<::fcl::CollisionGeometry<S>> mesh_geometry(const Solid& solid) {
  const auto mesh = std::make_shared<::fcl::BVHModel<::fcl::OBBRSS<S>>>();
  const auto point = [&](int i) -> ::fcl::Vector3<S> { return solid.points[static_cast<std::size_t>(i)].cast<S>(); };
  mesh->beginModel();
  for (const std::vector<int>& face : solid.faces)
    for (std::size_t i = 2; i < face.size(); ++i) mesh->addTriangle(point(face[0]), point(face[i - 1]), point(face[i]));
  mesh->endModel();
  return mesh;
}

template <class S>
std::shared_ptr<::fcl::CollisionGeometry<S>> octree_geometry(const Solid& solid) {
  const auto tree = std::make_shared<octomap::OcTree>(solid.size[0]);
  for (const Eigen::Vector3d& p : solid.points) tree->updateNode(p.x(), p.y(), p.z(), true);
  return std::make_shared<::fcl::OcTree<S>>(tree);
}

template <class S>
std::shared_ptr<::fcl::CollisionGeometry<S>> geometry(const Solid& solid) {
  const auto size = [&](std::size_t i) { return static_cast<S>(solid.size[i]); };
  switch (solid.kind) {
    case Kind::box:
      return std::make_shared<::fcl::Box<S>>(size(0), size(1), size(2));
    case Kind::sphere:
      return std::make_shared<::fcl::Sphere<S>>(size(0));
    case Kind::capsule:
      return std::make_shared<::fcl::Capsule<S>>(size(0), size(1));
    case Kind::cylinder:
      return std::make_shared<::fcl::Cylinder<S>>(size(0), size(1));
    case Kind::cone:
      return std::make_shared<::fcl::Cone<S>>(size(0), size(1));
    case Kind::half_space:
      return std::make_shared<::fcl::Halfspace<S>>(size(0), size(1), size(2), size(3));
    case Kind::mesh_box:
      return mesh_geometry<S>(solid);
    case Kind::cells:
      return octree_geometry<S>(solid);
    default:
      return hull_geometry<S>(solid);
  }
}

/// An object where the solid is, with its box computed.
template <class S>
std::unique_ptr<::fcl::CollisionObject<S>> object(const Solid& solid) {
  ::fcl::Transform3<S> transform = ::fcl::Transform3<S>::Identity();
  transform.linear() = solid.rotation.cast<S>();
  transform.translation() = solid.translation.cast<S>();
  return std::make_unique<::fcl::CollisionObject<S>>(geometry<S>(solid), transform);
}

}  // namespace boxstream::poses
