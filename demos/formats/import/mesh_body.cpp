// SPDX-License-Identifier: MIT
#include <cmath>
#include <stdexcept>

#include "formats/import/file_kind.hpp"
#include "formats/import/readers.hpp"
#include "formats/import/solid.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::imports {

void add_mesh_body(const std::string& path, const ImportOptions& options, Fragment& out) try {
  const TriangleMesh mesh = read_mesh(path);
  if (const std::size_t left_over = left_over_vertices(mesh); left_over > 0)
    out.note(std::to_string(left_over) + " vertices belong to no triangle: left out");
  BodyNote body;
  body.name = out.free_name("mesh");
  if (options.keep_still) {
    body.shape = out.add_shape(body.name, mesh_shape(mesh));
    body.more["type"] = "static";
    out.add_body(body);
    return;
  }
  const ConvexParts parts = convex_parts(mesh, options.parts.value_or(PartsOptions{}));
  double volume = 0;
  Vec3 moment{};
  for (const Hull& hull : parts.hulls) {
    volume += hull.volume;
    moment = plus(moment, times(hull.centroid, hull.volume));
  }
  Vec3 centre = times(moment, 1 / volume);
  if (parts.error) {
    const Solid solid = measure(mesh.vertices, mesh.triangles);
    volume = std::abs(solid.volume);
    centre = solid.centroid;
    out.note("the volume of its " + std::to_string(parts.hulls.size()) + " convex parts is " +
             std::to_string(100 * *parts.error) + " % larger than that of the mesh");
  } else {
    out.note("the mesh is not closed: the mass is that of its convex parts");
  }
  std::vector<Piece> pieces;
  for (const Hull& hull : parts.hulls) {
    std::vector<Vec3> points;
    for (const Vec3& p : hull.points) points.push_back(minus(p, centre));
    pieces.push_back({hull_shape(points), {}});
  }
  body.shape = out.add_pieces(body.name, pieces);
  body.place.origin = centre;
  constexpr double water = 1000;
  body.mass = volume * options.density.value_or(water);
  out.add_body(body);
} catch (const scenes::SceneError&) {
  throw;
} catch (const std::runtime_error& error) {
  fail(path, error.what());
}

}  // namespace boxstream::imports
