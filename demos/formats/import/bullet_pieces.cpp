// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numbers>
#include <stdexcept>

#include <BulletCollision/CollisionShapes/btConvexTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btScaledBvhTriangleMeshShape.h>

#include "formats/import/bullet_parts.hpp"
#include "formats/import/mesh.hpp"
#include "formats/import/mesh_reader.hpp"

namespace boxstream::imports {
namespace {

constexpr std::size_t most_pieces = 1000;
constexpr int deepest = 16;

/// The turn that takes y to the given axis.
Quat y_to(int axis) {
  constexpr double half = std::numbers::sqrt2 / 2;
  if (axis == 0) return {0, 0, -half, half};
  return axis == 1 ? Quat{0, 0, 0, 1} : y_to_z();
}

Json round_shape(const char* type, btScalar radius, btScalar height) {
  return {{"type", type}, {"radius", double{radius}}, {"height", double{height}}};
}

Json cylinder(const btCylinderShape& shape, int axis) {
  const btVector3 half = shape.getHalfExtentsWithMargin();
  const btScalar r = half[(axis + 1) % 3], other = half[(axis + 2) % 3];
  if (btFabs(r - other) > btScalar(1e-4) * btMax(r, other)) throw std::runtime_error("a cylinder that is not round");
  return round_shape("cylinder", r, 2 * half[axis]);
}

class Collect final : public btInternalTriangleIndexCallback {
 public:
  explicit Collect(RawMesh& mesh) : mesh_(mesh) {}

  void internalProcessTriangleIndex(btVector3* triangle, int, int) override {
    const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto single = [](btScalar x) { return static_cast<float>(x); };
    for (int i = 0; i < 3; ++i)
      mesh_.vertices.push_back({single(triangle[i].x()), single(triangle[i].y()), single(triangle[i].z())});
    mesh_.triangles.push_back({first, first + 1, first + 2});
  }

 private:
  RawMesh& mesh_;
};

RawMesh triangles_of(const btStridingMeshInterface& mesh) {
  RawMesh raw;
  Collect collect(raw);
  const btVector3 all(0, 0, 0);  // it gives every triangle anyway
  mesh.InternalProcessAllTriangles(&collect, all, all);
  return raw;
}

Json hull_json(const std::vector<Vec3>& points) {
  if (!std::all_of(points.begin(), points.end(), is_finite)) throw std::runtime_error("a number that is not finite");
  const auto hull = convex_hull(points);
  if (!hull) throw std::runtime_error("a flat hull");
  return hull_shape(hull->points);
}

Json convex_shape(const btCollisionShape& shape) {
  switch (shape.getShapeType()) {
    case BOX_SHAPE_PROXYTYPE:
      return box_shape(vector(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin()));
    case SPHERE_SHAPE_PROXYTYPE:
      return sphere_shape(double{static_cast<const btSphereShape&>(shape).getRadius()});
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      return round_shape("capsule", capsule.getRadius(), 2 * capsule.getHalfHeight());
    }
    case CYLINDER_SHAPE_PROXYTYPE: {
      const auto& round = static_cast<const btCylinderShape&>(shape);
      return cylinder(round, round.getUpAxis());
    }
    case CONE_SHAPE_PROXYTYPE: {
      const auto& cone = static_cast<const btConeShape&>(shape);
      return round_shape("cone", cone.getRadius(), cone.getHeight());
    }
    case CONVEX_HULL_SHAPE_PROXYTYPE: {
      const auto& hull = static_cast<const btConvexHullShape&>(shape);
      std::vector<Vec3> points;
      for (int i = 0; i < hull.getNumPoints(); ++i) points.push_back(vector(hull.getScaledPoint(i)));
      return hull_json(points);
    }
    case CONVEX_TRIANGLEMESH_SHAPE_PROXYTYPE: {
      const auto& mesh = static_cast<const btConvexTriangleMeshShape&>(shape);
      std::vector<Vec3> points;
      for (const auto& v : triangles_of(*mesh.getMeshInterface()).vertices)
        points.push_back({double{v[0]}, double{v[1]}, double{v[2]}});
      return hull_json(points);
    }
    default:
      throw std::runtime_error(std::string("a shape of kind ") + shape.getName());
  }
}

Quat turn_of(const btCollisionShape& shape) {
  switch (shape.getShapeType()) {
    case CAPSULE_SHAPE_PROXYTYPE:
      return y_to(static_cast<const btCapsuleShape&>(shape).getUpAxis());
    case CYLINDER_SHAPE_PROXYTYPE:
      return y_to(static_cast<const btCylinderShape&>(shape).getUpAxis());
    case CONE_SHAPE_PROXYTYPE:
      return y_to(static_cast<const btConeShape&>(shape).getConeUpIndex());
    default:
      return {0, 0, 0, 1};
  }
}

void add_pieces(const btCollisionShape& shape, const Frame& place, int depth, std::vector<Piece>& out) {
  if (depth > deepest) throw std::runtime_error("compounds nested too deeply");
  if (shape.getShapeType() != COMPOUND_SHAPE_PROXYTYPE) {
    if (out.size() >= most_pieces) throw std::runtime_error("a compound of more than 1000 pieces");
    out.push_back({convex_shape(shape), place.place(Frame{{}, turn_of(shape)})});
    return;
  }
  const auto& compound = static_cast<const btCompoundShape&>(shape);
  if (compound.getNumChildShapes() == 0) throw std::runtime_error("a compound of nothing");
  for (int i = 0; i < compound.getNumChildShapes(); ++i)
    add_pieces(*compound.getChildShape(i), place.place(frame_of(compound.getChildTransform(i))), depth + 1, out);
}

}  // namespace

std::vector<Piece> convex_pieces(const btCollisionShape& shape) {
  std::vector<Piece> pieces;
  add_pieces(shape, Frame{}, 0, pieces);
  return pieces;
}

std::optional<Json> fixed_shape(const std::string& path, const btCollisionShape& shape) {
  switch (shape.getShapeType()) {
    case STATIC_PLANE_PROXYTYPE: {
      const auto& plane = static_cast<const btStaticPlaneShape&>(shape);
      return Json{
          {"type", "plane"}, {"normal", vector(plane.getPlaneNormal())}, {"offset", double{plane.getPlaneConstant()}}};
    }
    case TRIANGLE_MESH_SHAPE_PROXYTYPE: {
      const auto& mesh = static_cast<const btTriangleMeshShape&>(shape);
      return mesh_shape(welded(path, triangles_of(*mesh.getMeshInterface()), {1, 1, 1}));
    }
    case SCALED_TRIANGLE_MESH_SHAPE_PROXYTYPE: {
      const auto& scaled = static_cast<const btScaledBvhTriangleMeshShape&>(shape);
      const RawMesh raw = triangles_of(*scaled.getChildShape()->getMeshInterface());
      return mesh_shape(welded(path, raw, vector(scaled.getLocalScaling())));
    }
    default:
      return std::nullopt;
  }
}

}  // namespace boxstream::imports
