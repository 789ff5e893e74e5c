// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "formats/import/file_kind.hpp"
#include "formats/import/geometry.hpp"
#include "formats/import/import_file.hpp"
#include "formats/import/mesh_reader.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::imports {

namespace {

/// Files of meshes do not say their unit, and many are in millimetres.
void note_large(const TriangleMesh& mesh, Fragment& out) {
  constexpr double large = 50;  // m
  double widest = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto [low, high] = std::minmax_element(mesh.vertices.begin(), mesh.vertices.end(),
                                                 [d](const Vec3& a, const Vec3& b) { return a[d] < b[d]; });
    widest = std::max(widest, (*high)[d] - (*low)[d]);
  }
  if (widest > large)
    out.note("the mesh is " + std::to_string(std::llround(widest)) + " m wide: a scale of 0.001 is for millimetres");
}

}  // namespace

void add_mesh_body(const std::string& path, const ImportOptions& options, Fragment& out) try {
  const TriangleMesh mesh = read_mesh(path, options.scale);
  const bool is_as_written = options.scale == scenes::Vec3{1, 1, 1};
  if (is_as_written && !options.keep_still) note_large(mesh, out);  // land may be large
  if (const std::size_t left_over = left_over_vertices(mesh); left_over > 0)
    out.note(std::to_string(left_over) + " vertices belong to no triangle: left out");
  if (const std::string note = surface_note(path); !note.empty()) out.note(note);
  BodyNote body;
  body.name = out.free_name("mesh");
  if (options.keep_still) {
    body.shape = out.add_shape(body.name, mesh_shape(mesh));
    body.more["type"] = "static";
    out.add_body(body);
    return;
  }
  const ConvexParts parts = convex_parts(mesh, options.parts.value_or(PartsOptions{}));
  constexpr double water = 1000;
  const double density = options.density.value_or(water);
  std::vector<Solid> hulls;
  for (const Hull& hull : parts.hulls) hulls.push_back(solid_of(hull));
  Solid solid = sum(hulls);
  if (parts.error) {
    solid = solid_of({mesh.vertices, mesh.triangles});
    const Tensor i = scaled(solid.inertia, density);
    body.more["inertia"] = {i[0][0], i[1][1], i[2][2], i[0][1], i[0][2], i[1][2]};
    out.note("the volume of its " + std::to_string(parts.hulls.size()) + " convex parts is " +
             std::to_string(100 * *parts.error) + " % larger than that of the mesh");
  } else {
    out.note("the mesh is not closed: the mass is that of its convex parts");
  }
  std::vector<Piece> pieces;
  for (const Hull& hull : parts.hulls) {
    std::vector<Vec3> points;
    for (const Vec3& p : hull.points) points.push_back(minus(p, solid.centroid));
    pieces.push_back({hull_shape(points), {}});
  }
  body.shape = out.add_pieces(body.name, pieces);
  body.place.origin = solid.centroid;
  body.mass = solid.volume * density;
  out.add_body(body);
} catch (const scenes::SceneError&) {
  throw;
} catch (const std::runtime_error& error) {
  fail(path, error.what());
}

}  // namespace boxstream::imports
