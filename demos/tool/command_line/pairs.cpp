// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream pairs boxes.txt
  boxstream pairs --list - < boxes.txt

One box a line: minx miny minz maxx maxy maxz, separated by blanks or commas; '#' starts a comment, and a first line
without a number names the columns. Boxes are closed: touching counts. --list prints the pairs in place of their number,
one a line, as numbers of boxes counted from 0.

JSON in place of rows gives convex shapes, as scenes do:
  {"format": 1,
   "shapes": [{"name": "ball", "type": "sphere", "radius": 1}, {"name": "slab", "type": "box", "half_extents": [4, 1, 4]}],
   "bodies": [{"shape": "slab"}, {"shape": "ball", "position": [0, 1.9, 0], "rotation": {"axis": [0, 0, 1], "degrees": 30}}]}
Shapes: box, sphere, capsule, cylinder, cone, hull. Pairs of boxes around them go to the narrow phase on libccd. --list
prints one line for each of these pairs, with names where bodies have them, else numbers:
  A B touch depth D direction X Y Z by METHOD    B leaves A when it moves by D along the direction
  A B apart distance D
and, in brackets, inexact or iteration limit where no solver could prove its answer: a depth is then an upper bound.)";

}  // namespace

void add_pairs(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<PairsOptions>();
  CLI::App* const command = app.add_subcommand("pairs", "Find the pairs in a file of boxes or convex shapes");
  command->add_option("FILE", options->file, "Rows of boxes, or JSON of shapes; - is standard input")->required();
  command->add_flag("--list", options->list, "Print the pairs");
  command
      ->add_option("--tolerance", options->tolerance,
                   "Shapes: largest error of depths and distances, as a fraction of the smaller shape; default: 1e-6")
      ->type_name("T")
      ->check(CLI::Range(1e-15, 0.1));
  command->add_option("--iterations", options->iterations, "Shapes: most iterations of one solver; default: 500")
      ->type_name("N")
      ->check(CLI::Range(1, 1'000'000));
  command
      ->add_option("--solver", options->solver,
                   "Shapes: libccd's gjk (with EPA) or mpr alone; default: auto, all of them")
      ->type_name("NAME")
      ->check(CLI::IsMember({"auto", "gjk", "mpr"}));
  command->footer(help);
  choose(*command, chosen, options, pairs_command);
}

}  // namespace boxstream::tool
