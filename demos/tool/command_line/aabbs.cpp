// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream simulate pile --record pile.aabbs
  boxstream aabbs pile.aabbs --compare dbvt
  boxstream aabbs Brownian.aabbs --broadphase dbvt --json - | jq .broadphases

Files of Broadmark: the boxes of the same objects, frame after frame. Each frame gives all boxes to the broad-phase and
asks for the pairs. Broad-phases: world, which is boxstream's own and the default, and those of simulate, as Bullet calls
them. No pair is filtered out, not even of two boxes that never move.

--compare asks two of them. "pairs equal: yes" means: in every frame the pairs whose boxes overlap are the same sets, and
those of an independent search. It stops at the first frame where they are not.

Times are from the first box of a frame to its last pair; the first frame makes the objects.

Exit code: 0; 1 if pairs differ; 2 for bad input: a file of another kind or size.)";

}  // namespace

void add_aabbs(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<AabbsOptions>();
  CLI::App* const command = app.add_subcommand("aabbs", "Find the pairs in each frame of a file of boxes");
  command->add_option("FILE", options->file, "Frames (simulate --record, or Broadmark); - is standard input")
      ->required();
  command->add_option("--broadphase", options->broadphase, "world, or as for simulate; default: world")
      ->type_name("NAME");
  command->add_option("--compare", options->compare, "Ask this one too, and compare pairs")->type_name("NAME");
  command->add_option("--json", options->json, "Write everything that was measured; - is standard output")
      ->type_name("FILE");
  last_counts(*command, {"--broadphase", "--compare", "--json"});
  command->footer(help);
  choose(*command, chosen, options, aabbs_command);
}

}  // namespace boxstream::tool
