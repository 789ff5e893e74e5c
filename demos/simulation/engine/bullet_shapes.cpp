// SPDX-License-Identifier: MIT
#include "simulation/engine/bullet_shapes.hpp"

#include <algorithm>
#include <numbers>

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <LinearMath/btConvexHullComputer.h>
#include <btBulletCollisionCommon.h>

#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

constexpr double pi = std::numbers::pi;

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

/// Bullet puts its collision margin around hulls and cones, 4 cm by default: too much for pebbles.
void keep_margin_small(btConvexInternalShape& shape) {
  btVector3 min, max;
  shape.getAabb(btTransform::getIdentity(), min, max);
  const btScalar margin = shape.getMargin();
  const btVector3 size = max - min - btVector3(2 * margin, 2 * margin, 2 * margin);
  shape.setMargin(std::min(margin, real(0.05) * std::min({size.x(), size.y(), size.z()})));
}

void triangulate_hull(const std::vector<Vec3>& points, BuiltShape& built) {
  btConvexHullComputer hull;
  hull.compute(points[0].data(), sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
  for (int i = 0; i < hull.vertices.size(); ++i) built.vertices.push_back(plain(hull.vertices[i]));
  for (int face = 0; face < hull.faces.size(); ++face) {
    const btConvexHullComputer::Edge* const first = &hull.edges[hull.faces[face]];
    const auto apex = static_cast<std::uint32_t>(first->getSourceVertex());
    for (const auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != first->getSourceVertex();
         edge = edge->getNextEdgeOfFace())
      built.triangles.push_back({apex, static_cast<std::uint32_t>(edge->getSourceVertex()),
                                 static_cast<std::uint32_t>(edge->getTargetVertex())});
  }
}

/// Signed tetrahedra from the origin to each triangle; faces are counter-clockwise seen from outside.
double enclosed_volume(const BuiltShape& built) {
  double six_times = 0;
  for (const auto& t : built.triangles) {
    const auto& a = built.vertices[t[0]];
    const auto& b = built.vertices[t[1]];
    const auto& c = built.vertices[t[2]];
    six_times += double{a[0]} * (double{b[1]} * c[2] - double{b[2]} * c[1]) +
                 double{a[1]} * (double{b[2]} * c[0] - double{b[0]} * c[2]) +
                 double{a[2]} * (double{b[0]} * c[1] - double{b[1]} * c[0]);
  }
  return std::abs(six_times) / 6;
}

struct Build {
  ShapeSet& set;
  BuiltShape& out;

  void operator()(const BoxShape& s) const {
    const btVector3 half = vector(s.half_extents);
    out.shape = std::make_unique<btBoxShape>(half);
    out.volume = 8 * s.half_extents[0] * s.half_extents[1] * s.half_extents[2];
    draw_as(out, Drawable::Kind::box, half.x(), half.y(), half.z());
  }
  void operator()(const SphereShape& s) const {
    out.shape = std::make_unique<btSphereShape>(real(s.radius));
    out.volume = 4.0 / 3 * pi * s.radius * s.radius * s.radius;
    draw_as(out, Drawable::Kind::sphere, real(s.radius));
  }
  void operator()(const CapsuleShape& s) const {
    out.shape = std::make_unique<btCapsuleShape>(real(s.radius), real(s.height));
    out.volume = pi * s.radius * s.radius * (s.height + 4.0 / 3 * s.radius);
    draw_as(out, Drawable::Kind::capsule, real(s.radius), real(s.height / 2));
  }
  void operator()(const CylinderShape& s) const {
    out.shape = std::make_unique<btCylinderShape>(btVector3(real(s.radius), real(s.height / 2), real(s.radius)));
    out.volume = pi * s.radius * s.radius * s.height;
    draw_as(out, Drawable::Kind::cylinder, real(s.radius), real(s.height / 2));
  }
  void operator()(const ConeShape& s) const {
    auto cone = std::make_unique<btConeShape>(real(s.radius), real(s.height));
    keep_margin_small(*cone);
    out.shape = std::move(cone);
    out.volume = pi * s.radius * s.radius * s.height / 3;
    draw_as(out, Drawable::Kind::cone, real(s.radius), real(s.height / 2));
  }
  void operator()(const HullShape& s) const {
    triangulate_hull(s.points, out);
    auto hull = std::make_unique<btConvexHullShape>();
    for (const auto& v : out.vertices) hull->addPoint(btVector3(v[0], v[1], v[2]), false);
    hull->recalcLocalAabb();
    keep_margin_small(*hull);
    out.shape = std::move(hull);
    out.volume = enclosed_volume(out);
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
    out.lift = (*low + *high) / 2;
    for (int row = 0; row < s.rows; ++row)
      for (int column = 0; column < s.columns; ++column)
        out.vertices.push_back({static_cast<float>((column - 0.5 * (s.columns - 1)) * s.cell),
                                out.heights[out.vertices.size()] - out.lift,
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
      compound->addChildShape(place, part.shape.get());
      out.volume += part.volume;
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

ShapeSet::ShapeSet(std::vector<Shape> shapes) : shapes_(std::move(shapes)), built_(shapes_.size()) {}

const BuiltShape& ShapeSet::get(std::size_t index) {
  if (!built_[index]) {
    auto built = std::make_unique<BuiltShape>();
    std::visit(Build{*this, *built}, shapes_[index].value);
    built_[index] = std::move(built);
  }
  return *built_[index];
}

}  // namespace boxstream::scenes
