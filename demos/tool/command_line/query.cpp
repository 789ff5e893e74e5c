// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream query query_arm
  boxstream query query_bins --compare tree
  boxstream query my-queries.json --manager tree --compare naive --steps 20 --json - | jq .managers[].queries

SCENE is a file, or the name of a scene that comes with the tool (boxstream list): groups of objects, each in a manager
of its own, that move along fixed courses, and queries after each step.
Managers: boxstream; FCL's own tree (DynamicAABBTreeCollisionManager), tree_array, ssap, sap, interval, hash and naive,
which holds every object against every other.

"broad" is the time of a query without what FCL's narrow phase takes in the callbacks, "narrow" is the latter. "update"
tells the managers what moved. Medians of the steps; "steps hit" are those with a pair that touches.

--compare asks two managers in turn, step by step, about the same objects. "answers equal: yes" means: in every step the
same pairs, contacts and distances, to the last bit. Pairs go to FCL's solvers in one fixed order, since (b, a) gives
other last digits than (a, b). Of FCL's managers sap, interval and hash are known to miss boxes that only touch.

Exit code: 0; 1 if answers differ or the run fails; 2 for bad input, with nothing written.)";

}  // namespace

void add_query(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<QueryOptions>();
  CLI::App* const command =
      app.add_subcommand("query", "Run a scene of queries on FCL: collisions and distances between groups of objects");
  command->add_option("SCENE", options->scene, "Scene file or name")->required();
  command
      ->add_option("--manager", options->manager,
                   "boxstream, boxstream_tight, tree, tree_array, ssap, sap, interval, hash or naive")
      ->type_name("NAME");
  command->add_option("--compare", options->compare, "Ask this one too, in turn, and compare answers")
      ->type_name("NAME");
  add_steps(*command, options->steps, "Number of steps; default: as the scene says");
  add_scale(*command, options->scale, "Scattered objects and vehicles: this many times as many; default: 1");
  command->add_option("--json", options->json, "Write everything that was measured; - is standard output")
      ->type_name("FILE");
  command->add_option("--picture", options->picture, "Draw the last step and the times: FILE.png or FILE.svg")
      ->type_name("FILE");
  last_counts(*command, {"--picture", "--manager", "--compare", "--steps", "--scale", "--json"});
  command->footer(help);
  choose(*command, chosen, options, query_command);
}

}  // namespace boxstream::tool
