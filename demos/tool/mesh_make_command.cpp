// SPDX-License-Identifier: MIT
#include <algorithm>

#include "commands.hpp"
#include "mesh/generators.hpp"
#include "painted_mesh.hpp"

namespace boxstream::tool {
namespace {

imports::TriangleMesh make(const std::string& surface, std::size_t n) {
  if (surface == "klein") return mesh::klein_bottle(n, std::max<std::size_t>(4, n / 4 * 2));
  if (surface == "sphere") return mesh::sphere(n / 2, n);
  return mesh::torus(n, n / 2);
}

}  // namespace

int mesh_make_command(const MeshMakeOptions& options) {
  PaintedMeshFile(options.output).write({make(options.surface, options.n), {}});
  return 0;
}

}  // namespace boxstream::tool
