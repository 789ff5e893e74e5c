// SPDX-License-Identifier: MIT
#include <algorithm>

#include "boxstream/mesh/painted_mesh.hpp"
#include "boxstream/shared/command.hpp"
#include "mesh/generators.hpp"

namespace boxstream::tool {
namespace {

struct MeshMakeOptions {
  std::string surface;  // "klein", "sphere", "torus"
  std::uint64_t n = 64;
  std::string output;
};

imports::TriangleMesh make(const std::string& surface, std::size_t n) {
  if (surface == "klein") return mesh::klein_bottle(n, std::max<std::size_t>(4, n / 4 * 2));
  if (surface == "sphere") return mesh::sphere(n / 2, n);
  return mesh::torus(n, n / 2);
}

int run_mesh_make(const MeshMakeOptions& options) {
  PaintedMeshFile(options.output).write({make(options.surface, options.n), {}, {}});
  return 0;
}

Action set_up_mesh_make(CommandLine& command) {
  const auto options = std::make_shared<MeshMakeOptions>();
  take_words(command, add_name(command, "SURFACE", options->surface, "{}; klein is a bottle that goes through itself"),
             "surface", {"klein", "sphere", "torus"})
      ->required();
  command.add_option("N", options->n, "Cells around; default: 64")->check(CLI::Range(8, 4000));
  command.add_option("-o,--out", options->output, "FILE.ply, .glb or .png")->type_name("FILE")->required();
  return [options] { return run_mesh_make(*options); };
}

}  // namespace

extern const Command mesh_make_command{"make", "Make a closed surface of about n^2 triangles", "", set_up_mesh_make};

}  // namespace boxstream::tool
