// SPDX-License-Identifier: MIT
// What becomes of triangles once a reader has them: welded, cut by planes, cut into convex parts, put into a fragment
// and loaded as a scene. The readers themselves are other people's, and run in a child process.
//
// Input: byte 0: the solid to begin with (none, tetrahedron, box, L, torus, two boxes); byte 1: how many convex parts
// at most; byte 2: the scale. Then changes: a code, modulo 4: 0 a vertex goes to a new place (which one, three
// numbers), 1 a new vertex (three numbers), 2 a new triangle (three vertices), 3 a triangle goes (which one).
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "bytes.hpp"
#include "finding.hpp"
#include "formats/import/clip.hpp"
#include "formats/import/convex_parts.hpp"
#include "formats/import/geometry.hpp"
#include "formats/import/mesh.hpp"
#include "formats/import/mesh_reader.hpp"
#include "formats/import/solids.hpp"
#include "loads_as_scene.hpp"

namespace boxstream::fuzz {
namespace {

using namespace imports;

constexpr std::size_t most_triangles = 200;

TriangleMesh beginning(unsigned choice) {
  TriangleMesh mesh;
  if (choice == 1) mesh = import_test::tetrahedron();
  if (choice == 2 || choice == 5) import_test::add_box(mesh, {0, 0, 0}, {1, 1, 1});
  if (choice == 3) mesh = import_test::ell();
  if (choice == 4) mesh = import_test::torus(2, 0.5, 8, 5);
  if (choice == 5) import_test::add_box(mesh, {2, 0, 0}, {3, 2, 1});
  return mesh;
}

RawMesh read_raw(Bytes& in, unsigned choice) {
  RawMesh raw;
  const TriangleMesh mesh = beginning(choice);
  for (const Vec3& v : mesh.vertices) raw.vertices.push_back({v[0], v[1], v[2]});
  raw.triangles = mesh.triangles;
  const auto point = [&] {
    const float x = in.number<float>(), y = in.number<float>();
    return std::array<double, 3>{x, y, in.number<float>()};
  };
  while (!in.empty() && raw.triangles.size() < most_triangles) {
    const unsigned code = in.below(4);
    const auto vertex = [&] { return static_cast<std::uint32_t>(in.byte() % raw.vertices.size()); };
    if (code == 1 || raw.vertices.empty())
      raw.vertices.push_back(point());
    else if (code == 0)
      raw.vertices[vertex()] = point();
    else if (code == 2)
      raw.triangles.push_back({vertex(), vertex(), vertex()});
    else if (!raw.triangles.empty())
      raw.triangles.erase(raw.triangles.begin() + in.byte() % static_cast<int>(raw.triangles.size()));
  }
  return raw;
}

double extent_of(const std::vector<Vec3>& points) {
  double extent = 0;
  for (const Vec3& p : points)
    for (std::size_t d = 0; d < 3; ++d) extent = std::max(extent, std::abs(p[d] - points[0][d]));
  return extent;
}

/// Is there a face's direction in which the point lies farther out than all corners?
bool is_outside(const Hull& hull, const Vec3& point, double tolerance) {
  return std::any_of(hull.triangles.begin(), hull.triangles.end(), [&](const auto& t) {
    const Vec3& a = hull.points[t[0]];
    Vec3 normal = cross(minus(hull.points[t[1]], a), minus(hull.points[t[2]], a));
    if (dot(normal, minus(hull.centroid, a)) > 0) normal = times(normal, -1);
    const double beyond = tolerance * std::sqrt(dot(normal, normal)), there = dot(normal, minus(point, a));
    return std::none_of(hull.points.begin(), hull.points.end(),
                        [&](const Vec3& corner) { return there - dot(normal, minus(corner, a)) <= beyond; });
  });
}

void check_halves(const TriangleMesh& mesh) {
  std::vector<Facet> facets;
  for (const auto& t : mesh.triangles)
    facets.push_back({{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}});
  const double volume = signed_volume(facets), extent = extent_of(mesh.vertices);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Vec3& corner = mesh.vertices[mesh.triangles[0][axis]];
    for (const double value : {corner[axis], corner[axis] + extent / 3}) {
      const Halves halves = clip(facets, axis, value);
      for (const Facet& facet : halves.low)
        for (const Vec3& p : facet.corners) promise(p[axis] <= value, "the low half reaches beyond the cut");
      for (const Facet& facet : halves.high)
        for (const Vec3& p : facet.corners) promise(p[axis] >= value, "the high half reaches beyond the cut");
      const double sum = signed_volume(halves.low) + signed_volume(halves.high);
      const double tolerance = 1e-9 * static_cast<double>(facets.size() + 1) * extent * extent * extent;
      promise(!is_closed(mesh.triangles) || std::abs(sum - volume) <= tolerance, "the halves have another volume");
    }
  }
}

void check_parts(const TriangleMesh& mesh, const ConvexParts& parts, std::size_t most) {
  promise(!parts.hulls.empty() && parts.hulls.size() <= most, "number of parts");
  promise(!parts.error || std::isfinite(*parts.error), "an error that is not finite");
  const double extent = extent_of(mesh.vertices);
  for (const Hull& hull : parts.hulls) {
    promise(hull.volume > 0 && std::isfinite(hull.volume) && is_finite(hull.centroid), "a hull without volume");
    promise(hull.points.size() <= most_hull_points, "corners of a hull");
    for (const auto& t : hull.triangles)
      for (const std::uint32_t corner : t) promise(corner < hull.points.size(), "a triangle of a hull");
  }
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle)
      promise(std::any_of(parts.hulls.begin(), parts.hulls.end(),
                          [&](const Hull& hull) { return !is_outside(hull, mesh.vertices[v], 1e-3 * extent); }),
              "a vertex is in no part");
}

void load(const ConvexParts& parts) {
  Fragment fragment{Frame{}};
  std::vector<Piece> pieces;
  for (const Hull& hull : parts.hulls) pieces.push_back({hull_shape(hull.points), {}});
  BodyNote body;
  body.name = fragment.free_name("mesh");
  body.shape = fragment.add_pieces(body.name, pieces);
  body.mass = 1;
  fragment.add_body(body);
  bodies_as_scene(fragment);
}

void run(Bytes& in) {
  const unsigned choice = in.below(6);
  PartsOptions options;
  options.max_hulls = 1 + in.below(6);
  const unsigned scale = in.byte();
  const Vec3 factors{(scale & 1) != 0 ? -1.0 : 1.0, (scale & 2) != 0 ? 1e-3 : 1.0, (scale & 4) != 0 ? 1e3 : 1.0};
  const RawMesh raw = read_raw(in, choice);
  const TriangleMesh mesh = welded("/nowhere/fuzz.obj", raw, factors);
  check_halves(mesh);
  try {
    const ConvexParts parts = convex_parts(mesh, options);
    check_parts(mesh, parts, options.max_hulls);
    load(parts);
  } catch (const std::runtime_error& error) {
    promise(error.what() == std::string("the mesh is flat"), error.what());
  }
}

}  // namespace
}  // namespace boxstream::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace boxstream;
  fuzz::Bytes in(data, size);
  try {
    fuzz::run(in);
  } catch (const scenes::SceneError& error) {
    fuzz::promise_one_line(error.what());
  }
  return 0;
}
