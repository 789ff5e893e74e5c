// SPDX-License-Identifier: MIT
#include "simulation/query/objects.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>

namespace boxstream::query {
namespace {

using Geometry = std::shared_ptr<::fcl::CollisionGeometry<double>>;

struct MakeGeometry {
  Geometry operator()(const scenes::BoxShape& s) const {
    return std::make_shared<::fcl::Box<double>>(2 * s.half_extents[0], 2 * s.half_extents[1], 2 * s.half_extents[2]);
  }
  Geometry operator()(const scenes::SphereShape& s) const { return std::make_shared<::fcl::Sphere<double>>(s.radius); }
  Geometry operator()(const scenes::CapsuleShape& s) const {
    return std::make_shared<::fcl::Capsule<double>>(s.radius, s.height);
  }
  Geometry operator()(const scenes::CylinderShape& s) const {
    return std::make_shared<::fcl::Cylinder<double>>(s.radius, s.height);
  }
  Geometry operator()(const scenes::ConeShape& s) const {
    return std::make_shared<::fcl::Cone<double>>(s.radius, s.height);
  }
  Geometry operator()(const scenes::MeshShape& s) const {
    std::vector<::fcl::Vector3<double>> vertices;
    for (const Vec3& v : s.vertices) vertices.emplace_back(v[0], v[1], v[2]);
    std::vector<::fcl::Triangle> triangles;
    for (const auto& t : s.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    auto model = std::make_shared<::fcl::BVHModel<::fcl::OBBRSS<double>>>();
    model->beginModel(static_cast<int>(triangles.size()), static_cast<int>(vertices.size()));
    model->addSubModel(vertices, triangles);
    model->endModel();
    return model;
  }
};

/// Ours lie along y, FCL's along z.
bool lies_along_y(const ShapeValue& shape) {
  return std::holds_alternative<scenes::CapsuleShape>(shape) || std::holds_alternative<scenes::CylinderShape>(shape) ||
         std::holds_alternative<scenes::ConeShape>(shape);
}

}  // namespace

void WideObject::move(const Pose& pose) {
  setTransform(pose);
  computeAABB();
  if (half_margin_ > 0) aabb.expand(::fcl::Vector3<double>::Constant(half_margin_));
}

Objects::Objects(const QueryScene& scene, const ObjectMotion& motion)
    : all_(scene.groups.size()), moving_(scene.groups.size()) {
  for (const auto& group : scene.groups) margins_.push_back(group.margin);
  Pose z_to_y = Pose::Identity();
  z_to_y.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  std::vector<Geometry> geometries;
  for (const ShapeValue& shape : motion.shapes()) {
    geometries.push_back(std::visit(MakeGeometry{}, shape));
    to_fcl_.push_back(lies_along_y(shape) ? z_to_y : Pose::Identity());
  }
  for (std::size_t i = 0; i < motion.objects().size(); ++i) {
    const Object& object = motion.objects()[i];
    objects_.emplace_back(geometries[object.shape], i, scene.groups[object.group].margin);
    objects_.back().move(motion.poses()[i] * to_fcl_[object.shape]);
    all_[object.group].push_back(&objects_.back());
    if (object.moves) moving_[object.group].push_back(&objects_.back());
  }
}

void Objects::follow(const ObjectMotion& motion) {
  for (WideObject& object : objects_) {
    const std::size_t i = object.index();
    const Object& o = motion.objects()[i];
    if (o.moves) object.move(motion.poses()[i] * to_fcl_[o.shape]);
  }
}

Extent Objects::extent_of(std::size_t group) const {
  Extent extent;
  double sides = 0;
  for (const auto* const object : all_[group]) {
    extent.all += object->getAABB();
    sides += (object->getAABB().max_ - object->getAABB().min_).sum();
  }
  extent.objects = all_[group].size();
  extent.margin = margins_[group];
  if (extent.objects == 0) extent.all = ::fcl::AABB<double>(::fcl::Vector3<double>::Zero());
  if (sides > 0) extent.mean_side = sides / (3 * static_cast<double>(extent.objects));
  return extent;
}

}  // namespace boxstream::query
