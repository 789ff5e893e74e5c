// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream import robot.urdf -o robot.json --fixed-base --floor 0
  boxstream import arm.urdf -o arm.json --hold --package-path ~/ros/src
  boxstream import world.bullet -o world.json
  boxstream import part.stl -o part.json --up z --hulls 32 --floor -1

FILE is a robot (.urdf), a world (.bullet) or a mesh (.obj, .stl, .ply, .dae, .gltf, .glb). A mesh becomes one body of convex
parts. What scenes have no word for is named on standard error, a line each. Scenes can also name such files themselves:
generators of type import, shapes with "file".

Exit code: 0; 2 for a file that cannot be read or carried over, with nothing written.)";

}  // namespace

void add_import(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<ImportOptions>();
  CLI::App* const command = app.add_subcommand("import", "Make a scene of a robot, a world or a mesh");
  command->add_option("FILE", options->file, ".urdf, .bullet, .obj, .stl, .ply, .dae, .gltf or .glb")->required();
  command->add_option("-o,--output", options->output, "Scene to write; - is standard output")
      ->type_name("FILE")
      ->required();
  command->add_option("--up", options->up, "The file's upward axis; default: z for .urdf, else y")
      ->type_name("AXIS")
      ->check(CLI::IsMember({"y", "z"}));
  command->add_option("--floor", options->floor, "Add a ground plane at this height")
      ->type_name("Y")
      ->check(CLI::Range(-1e5, 1e5));
  command->add_flag("--fixed-base", options->fixed_base, "URDF: the root link does not move");
  command->add_flag("--hold", options->hold, "URDF: motors that keep joints where they are, as strong as their effort");
  command
      ->add_option("--package-path", options->packages,
                   "URDF: folder that package:// means, or that holds it; may be repeated")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  command->add_flag("--static", options->keep_still, "Mesh: a static triangle mesh in place of convex parts");
  command->add_option("--density", options->density, "kg/m^3 of meshes (1000) and of links without a mass (an error)")
      ->type_name("D")
      ->check(CLI::Range(1e-6, 1e5));
  command->add_option("--hulls", options->hulls, "Cut meshes into at most so many convex parts; 16, for URDF 1")
      ->type_name("N")
      ->check(CLI::Range(1, 256));
  command->add_option("--error", options->error, "With --hulls: volume that is enough, as a fraction; default: 0.05")
      ->type_name("E")
      ->check(CLI::Range(0.0, 100.0));
  command->footer(help);
  choose(*command, chosen, options, import_command);
}

}  // namespace boxstream::tool
