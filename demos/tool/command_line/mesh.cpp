// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream mesh make klein 200 --out klein.ply
  boxstream mesh check klein.ply --picture klein.png
  boxstream mesh distance original.stl simplified.stl --picture error.ply

Files are read as .obj, .stl, .ply, .dae, .gltf and .glb; vertices at the same place are one. They are written as .ply and
.glb, with a colour for each vertex, or .png.

check finds all pairs of triangles that intersect, exactly, touching and lying in one plane included. Triangles that
share a vertex or an edge count if they have more in common than that. Triangles without area are counted, and in no
pair. The picture has triangles that intersect in red.

distance is that of the vertices of each surface from the other surface. Between vertices it can be larger. Pictures go
from black, where the surfaces meet, over red and yellow to white, where they are farthest apart.

Exit code: 0; 1 if check finds a pair, or a run fails; 2 for bad input, with nothing written.)";

void add_check(CLI::App& mesh, Chosen& chosen) {
  const auto options = std::make_shared<MeshCheckOptions>();
  CLI::App* const command = mesh.add_subcommand("check", "Find the triangles of a surface that intersect");
  command->add_option("FILE", options->file, "Mesh")->required();
  command->add_flag("--list", options->list, "Print all pairs, by numbers of triangles from 0 on");
  command->add_option("--picture", options->picture, "Write it with them in red: FILE.ply, .glb or .png")
      ->type_name("FILE");
  choose(*command, chosen, options, mesh_check_command);
}

void add_distance(CLI::App& mesh, Chosen& chosen) {
  const auto options = std::make_shared<MeshDistanceOptions>();
  CLI::App* const command = mesh.add_subcommand("distance", "Say how far two surfaces are apart");
  command->add_option("A", options->a, "Mesh")->required();
  command->add_option("B", options->b, "Mesh")->required();
  command->add_option("--picture", options->picture, "Write A, coloured by distance from B: FILE.ply, .glb or .png")
      ->type_name("FILE");
  command->add_option("--picture-back", options->picture_back, "Write B, coloured by distance from A")
      ->type_name("FILE");
  choose(*command, chosen, options, mesh_distance_command);
}

void add_make(CLI::App& mesh, Chosen& chosen) {
  const auto options = std::make_shared<MeshMakeOptions>();
  CLI::App* const command = mesh.add_subcommand("make", "Make a closed surface of about n^2 triangles");
  command->add_option("SURFACE", options->surface, "klein, a bottle that goes through itself; sphere; torus")
      ->check(CLI::IsMember({"klein", "sphere", "torus"}))
      ->required();
  command->add_option("N", options->n, "Cells around; default: 64")->check(CLI::Range(8, 4000));
  command->add_option("-o,--out", options->output, "FILE.ply, .glb or .png")->type_name("FILE")->required();
  choose(*command, chosen, options, mesh_make_command);
}

}  // namespace

void add_mesh(CLI::App& app, Chosen& chosen) {
  CLI::App* const mesh = app.add_subcommand("mesh", "Surfaces: self-intersections, and the distance of two");
  mesh->require_subcommand(1);
  mesh->footer(help);
  add_check(*mesh, chosen);
  add_distance(*mesh, chosen);
  add_make(*mesh, chosen);
}

}  // namespace boxstream::tool
