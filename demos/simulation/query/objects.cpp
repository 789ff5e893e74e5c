// SPDX-License-Identifier: MIT
#include "simulation/query/objects.hpp"

#include <fcl/broadphase/broadphase_SSaP.h>
#include <fcl/broadphase/broadphase_SaP.h>
#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree_array.h>
#include <fcl/broadphase/broadphase_interval_tree.h>
#include <fcl/broadphase/broadphase_spatialhash.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <boxstream/fcl.hpp>
#include <boxstream/fcl/tight_box.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "simulation/query/run.hpp"

namespace boxstream::query {
namespace {

struct Named {
  std::string name;
  std::function<std::unique_ptr<Manager>(const Extent&)> make;
};

template <template <class> class Kind>
Named plain(const char* name) {
  return {name, [](const Extent&) { return std::make_unique<Kind<double>>(); }};
}

std::unique_ptr<Manager> make_tight(const Extent& extent) {
  auto manager = std::make_unique<boxstream::fcl::CollisionManager<double>>();
  manager->setBoxSource(&boxstream::fcl::tightBox<double>);
  manager->setMargin(extent.margin);
  return manager;
}

/// Pairs by the paper's tree.
std::unique_ptr<Manager> make_hybrid(const Extent&) {
  DetectorOptions options;
  options.method = Method::hybrid;
  return std::make_unique<boxstream::fcl::CollisionManager<double>>(options);
}

/// Cells of two mean sides. Objects beyond the limits are held against all others, hence the room.
std::unique_ptr<Manager> make_hash(const Extent& extent) {
  const Eigen::Vector3d room = 0.5 * (extent.all.max_ - extent.all.min_) + Eigen::Vector3d::Constant(extent.mean_side);
  return std::make_unique<::fcl::SpatialHashingCollisionManager<double>>(
      2 * extent.mean_side, extent.all.min_ - room, extent.all.max_ + room,
      static_cast<unsigned>(std::max<std::size_t>(1, extent.objects)));
}

const std::vector<Named>& managers() {
  static const std::vector<Named> all{
      {"boxstream", [](const Extent&) { return std::make_unique<boxstream::fcl::CollisionManager<double>>(); }},
      {"boxstream_tight", make_tight},
      {"hybrid", make_hybrid},
      plain<::fcl::DynamicAABBTreeCollisionManager>("tree"),
      plain<::fcl::DynamicAABBTreeCollisionManager_Array>("tree_array"),
      plain<::fcl::SSaPCollisionManager>("ssap"),
      plain<::fcl::SaPCollisionManager>("sap"),
      plain<::fcl::IntervalTreeCollisionManager>("interval"),
      {"hash", make_hash},
      plain<::fcl::NaiveCollisionManager>("naive")};
  return all;
}

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

const std::vector<std::string>& manager_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Named& manager : managers()) list.push_back(manager.name);
    return list;
  }();
  return names;
}

std::unique_ptr<Manager> make_manager(const std::string& name, const Extent& extent) {
  for (const Named& manager : managers())
    if (manager.name == name) return manager.make(extent);
  throw std::invalid_argument("no manager called " + name);
}

bool updates_lists(const std::string& name) {
  return name != "interval";
}

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

scenes::MeshShape ring_mesh(double radius, double tube, int around, int across) {
  scenes::MeshShape mesh;
  for (int i = 0; i < around; ++i) {
    const double u = 2 * std::numbers::pi * i / around;
    for (int j = 0; j < across; ++j) {
      const double v = 2 * std::numbers::pi * j / across;
      const double out = radius + tube * std::cos(v);
      mesh.vertices.push_back({out * std::cos(u), tube * std::sin(v), out * std::sin(u)});
    }
  }
  const auto corner = [&](int i, int j) { return static_cast<std::uint32_t>(i % around * across + j % across); };
  for (int i = 0; i < around; ++i) {
    for (int j = 0; j < across; ++j) {
      mesh.triangles.push_back({corner(i, j), corner(i, j + 1), corner(i + 1, j)});
      mesh.triangles.push_back({corner(i + 1, j), corner(i, j + 1), corner(i + 1, j + 1)});
    }
  }
  return mesh;
}

scenes::MeshShape bracket_mesh(double length, double width, double thickness) {
  const double s = length, t = thickness;
  // Counter-clockwise, around the middle of the square that holds the L.
  const double outline[6][2] = {{0, 0}, {s, 0}, {s, t}, {t, t}, {t, s}, {0, s}};
  scenes::MeshShape mesh;
  for (const double z : {-width / 2, width / 2})
    for (const auto& [x, y] : outline) mesh.vertices.push_back({x - s / 2, y - s / 2, z});
  // The two ends, each as two quadrilaterals.
  const std::uint32_t end[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto& [a, b, c] : end) {
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t next = (i + 1) % 6;
    mesh.triangles.push_back({i, next, next + 6});
    mesh.triangles.push_back({i, next + 6, i + 6});
  }
  return mesh;
}

}  // namespace boxstream::query
