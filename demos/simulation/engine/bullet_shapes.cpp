// SPDX-License-Identifier: MIT
#include "simulation/engine/bullet_shapes.hpp"

#include <algorithm>

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <btBulletCollisionCommon.h>

#include "formats/geometry/solid.hpp"
#include "simulation/engine/cone.hpp"
#include "simulation/engine/contacts/hull_shape.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

void draw_as(BuiltShape& built, Drawable::Kind kind, float x, float y = 0, float z = 0) {
  Drawable drawable;
  drawable.kind = kind;
  drawable.size = {x, y, z};
  built.drawables.push_back(drawable);
}

void draw_triangles(BuiltShape& built) {
  Drawable drawable;
  drawable.kind = Drawable::Kind::triangles;
  drawable.vertices = built.vertices;
  drawable.triangles = built.triangles;
  built.drawables.push_back(drawable);
}

bool is_identity(const geometry::Frame& frame) {
  return frame.origin == Vec3{} && frame.turn == Quat{0, 0, 0, 1};
}

/// Of a shape of the set, in the coordinates of its description.
struct SolidOf {
  ShapeSet& set;
  std::size_t index;

  geometry::Solid operator()(const BoxShape& s) const { return geometry::box(s.half_extents); }
  geometry::Solid operator()(const SphereShape& s) const { return geometry::ball(s.radius); }
  geometry::Solid operator()(const CapsuleShape& s) const { return geometry::capsule(s.radius, s.height); }
  geometry::Solid operator()(const CylinderShape& s) const { return geometry::cylinder(s.radius, s.height); }
  geometry::Solid operator()(const ConeShape& s) const { return geometry::cone(s.radius, s.height); }
  geometry::Solid operator()(const HullShape&) const { return geometry::solid_of(set.hull(index)); }
  geometry::Solid operator()(const CompoundShape& s) const {
    std::vector<geometry::Solid> parts;
    for (const CompoundChild& child : s.children)
      parts.push_back(geometry::placed({child.position, child.rotation}, set.solid(child.shape)));
    return geometry::sum(parts);
  }
  geometry::Solid operator()(const PlaneShape&) const { return {}; }
  geometry::Solid operator()(const HeightfieldShape&) const { return {}; }
  geometry::Solid operator()(const MeshShape&) const { return {}; }
};

struct Build {
  ShapeSet& set;
  std::size_t index;
  BuiltShape& out;

  /// Where a place of the description is for Bullet.
  Vec3 seen(const Vec3& place) const {
    return is_identity(out.frame) ? place : out.frame.seen(geometry::Frame{place, {0, 0, 0, 1}}).origin;
  }

  /// A shape that Bullet has around its own middle only, as the single part of a compound.
  void move(std::unique_ptr<btConvexInternalShape> shape) const {
    if (const auto margin = set.margin(index); margin && shape->getShapeType() != CUSTOM_CONVEX_SHAPE_TYPE)
      shape->setMargin(real(*margin));
    if (is_identity(out.frame)) {
      out.shape = std::move(shape);
      return;
    }
    const geometry::Frame middle = out.frame.seen({});
    auto moved = std::make_unique<btCompoundShape>(false, 1);
    moved->addChildShape(transform(middle.origin, middle.turn), shape.get());
    out.part = std::move(shape);
    out.shape = std::move(moved);
  }

  void operator()(const BoxShape& s) const {
    const btVector3 half = vector(s.half_extents);
    move(std::make_unique<btBoxShape>(half));
    draw_as(out, Drawable::Kind::box, half.x(), half.y(), half.z());
  }
  void operator()(const SphereShape& s) const {
    move(std::make_unique<btSphereShape>(real(s.radius)));
    draw_as(out, Drawable::Kind::sphere, real(s.radius));
  }
  void operator()(const CapsuleShape& s) const {
    move(std::make_unique<btCapsuleShape>(real(s.radius), real(s.height)));
    draw_as(out, Drawable::Kind::capsule, real(s.radius), real(s.height / 2));
  }
  void operator()(const CylinderShape& s) const {
    move(std::make_unique<btCylinderShape>(btVector3(real(s.radius), real(s.height / 2), real(s.radius))));
    draw_as(out, Drawable::Kind::cylinder, real(s.radius), real(s.height / 2));
  }
  void operator()(const ConeShape& s) const {
    const auto& [x, y, z] = out.frame.origin;
    const btScalar margin = real(set.margin(index).value_or(0));
    if (x == 0 && z == 0 && out.frame.turn == Quat{0, 0, 0, 1})
      out.shape = std::make_unique<Cone>(real(s.radius), real(s.height), real(-y), margin);
    else
      move(std::make_unique<Cone>(real(s.radius), real(s.height), btScalar(0), margin));
    draw_as(out, Drawable::Kind::cone, real(s.radius), real(s.height / 2));
  }
  // A margin of Bullet's would make it larger than described.
  void operator()(const HullShape&) const {
    const geometry::Hull& hull = set.hull(index);
    for (const Vec3& corner : hull.points) out.vertices.push_back(plain(vector(corner)));
    out.triangles = hull.triangles;
    const double margin = set.margin(index).value_or(0);
    const auto core = margin > 0 ? geometry::shrunk(hull, margin) : std::nullopt;
    const geometry::Hull& solid = core ? *core : hull;
    std::vector<Vec3> corners;
    for (const Vec3& corner : solid.points) corners.push_back(seen(corner));
    out.shape = std::make_unique<HullOfFaces>(solid, corners);
    if (core) out.shape->setMargin(real(margin));
    draw_triangles(out);
  }
  void operator()(const PlaneShape& s) const {
    out.shape = std::make_unique<btStaticPlaneShape>(vector(s.normal), real(s.offset));
    Drawable plane;
    plane.kind = Drawable::Kind::plane;
    plane.size = plain(vector(s.normal));
    plane.position = plain(vector(s.normal) * real(s.offset));
    out.drawables.push_back(plane);
  }
  void operator()(const HeightfieldShape& s) const {
    out.heights = s.heights;
    const auto [low, high] = std::minmax_element(out.heights.begin(), out.heights.end());
    auto field =
        std::make_unique<btHeightfieldTerrainShape>(s.columns, s.rows, out.heights.data(), *low, *high, 1, false);
    field->setLocalScaling(btVector3(real(s.cell), 1, real(s.cell)));
    out.shape = std::move(field);
    out.frame = {{0, double{(*low + *high) / 2}, 0}, {0, 0, 0, 1}};
    for (int row = 0; row < s.rows; ++row)
      for (int column = 0; column < s.columns; ++column)
        out.vertices.push_back({static_cast<float>((column - 0.5 * (s.columns - 1)) * s.cell),
                                out.heights[out.vertices.size()],
                                static_cast<float>((row - 0.5 * (s.rows - 1)) * s.cell)});
    // The diagonal that Bullet uses when quads are not flipped.
    const auto columns = static_cast<std::uint32_t>(s.columns);
    for (std::uint32_t row = 0; row + 1 < static_cast<std::uint32_t>(s.rows); ++row) {
      for (std::uint32_t column = 0; column + 1 < columns; ++column) {
        const std::uint32_t a = row * columns + column;
        out.triangles.push_back({a, a + columns, a + 1});
        out.triangles.push_back({a + 1, a + columns, a + columns + 1});
      }
    }
    draw_triangles(out);
  }
  void operator()(const MeshShape& s) const {
    for (const Vec3& v : s.vertices) out.vertices.push_back(plain(vector(v)));
    out.triangles = s.triangles;
    btIndexedMesh part;
    part.m_numTriangles = static_cast<int>(out.triangles.size());
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(out.triangles.data());
    part.m_triangleIndexStride = sizeof(out.triangles[0]);
    part.m_numVertices = static_cast<int>(out.vertices.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(out.vertices.data());
    part.m_vertexStride = sizeof(out.vertices[0]);
    part.m_vertexType = PHY_FLOAT;
    auto mesh = std::make_unique<btTriangleIndexVertexArray>();
    mesh->addIndexedMesh(part, PHY_INTEGER);
    out.shape = std::make_unique<btBvhTriangleMeshShape>(mesh.get(), true);
    out.mesh = std::move(mesh);
    draw_triangles(out);
  }
  void operator()(const CompoundShape& s) const {
    auto compound = std::make_unique<btCompoundShape>(true, static_cast<int>(s.children.size()));
    for (const CompoundChild& child : s.children) {
      const BuiltShape& part = set.get(child.shape);
      const btTransform place = transform(child.position, child.rotation);
      const geometry::Frame there = out.frame.seen({child.position, child.rotation});
      compound->addChildShape(is_identity(out.frame) ? place : transform(there.origin, there.turn), part.shape.get());
      for (Drawable drawable : part.drawables) {
        const btMatrix3x3& m = place.getBasis();
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) drawable.rotation[static_cast<std::size_t>(3 * r + c)] = m[r][c];
        drawable.position = plain(place.getOrigin());
        out.drawables.push_back(drawable);
      }
    }
    out.shape = std::move(compound);
  }
};

}  // namespace

ShapeSet::ShapeSet(std::vector<Shape> shapes)
    : shapes_(std::move(shapes)), solids_(shapes_.size()), hulls_(shapes_.size()) {}

const geometry::Hull& ShapeSet::hull(std::size_t index) {
  if (!hulls_[index]) {
    const std::vector<Vec3>& points = std::get<HullShape>(shapes_[index].value).points;
    auto hull = geometry::convex_hull(points);
    hulls_[index] = std::make_unique<geometry::Hull>(hull ? std::move(*hull) : geometry::rough_hull(points));
  }
  return *hulls_[index];
}

const geometry::Solid& ShapeSet::solid(std::size_t index) {
  if (!solids_[index])
    solids_[index] = std::make_unique<geometry::Solid>(std::visit(SolidOf{*this, index}, shapes_[index].value));
  return *solids_[index];
}

const BuiltShape& ShapeSet::get(std::size_t index, const geometry::Frame& frame) {
  const auto& [x, y, z] = frame.origin;
  const auto& [i, j, k, w] = frame.turn;
  std::unique_ptr<BuiltShape>& known = built_[{index, {x, y, z, i, j, k, w}}];
  if (!known) {
    auto built = std::make_unique<BuiltShape>();
    built->volume = solid(index).volume;
    built->frame = frame;
    std::visit(Build{*this, index, *built}, shapes_[index].value);
    known = std::move(built);
  }
  return *known;
}

}  // namespace boxstream::scenes
