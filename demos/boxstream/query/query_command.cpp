// SPDX-License-Identifier: MIT
#include "boxstream/query/run_queries.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/scene_files.hpp"

namespace boxstream::tool {
namespace {

Action set_up_query(CommandLine& command) {
  const auto options = std::make_shared<QueryOptions>();
  add_scene(command, options->scene, SceneKind::query);
  take_words(command, add_name(command, "--manager", options->manager, "{}; default: the first"), "manager",
             manager_names());
  take_words(command,
             add_name(command, "--compare", options->compare, "Run the queries on this one too, and compare answers"),
             "manager", manager_names());
  add_steps(command, options->steps, "Number of steps; default: as the scene says");
  add_scale(command, options->scale, "Scattered objects and vehicles: this many times as many; default: 1");
  add_json(command, options->json);
  add_file(command, "--picture", options->picture, "Draw the last step and the times: FILE.png or FILE.svg");
  command.last_counts({"--picture", "--manager", "--compare", "--steps", "--scale", "--json"});
  return [options] { return run_queries(*options); };
}

}  // namespace

extern const Command query_command{"query",
                                   "Run a scene of queries on FCL: collisions and distances between groups of objects",
                                   R"(Examples:
  boxstream query query_arm
  boxstream query query_bins --compare tree
  boxstream query my-queries.json --manager tree --compare naive --steps 20 --json - | jq .managers[].queries

SCENE is a file, or the name of a scene that comes with the tool (boxstream list): groups of objects, each in a manager
of its own, that move along fixed courses, and queries after each step.
Managers: boxstream; FCL's own tree (DynamicAABBTreeCollisionManager), tree_array, ssap, sap, interval, hash and naive,
which tests every pair of objects.

"broad" is the time of a query without what FCL's narrow phase takes in the callbacks, "narrow" is the latter. "update"
tells the managers what moved. Medians of the steps; "steps hit" are those with a pair that touches.

--compare runs the same queries on two managers, step by step. "answers equal: yes" means: in every step the
same pairs, contacts and distances, to the last bit. Pairs go to FCL's solvers in one fixed order, since (b, a) gives
other last digits than (a, b). Of FCL's managers sap, interval and hash are known to miss boxes that only touch.

Exit code: 0; 1 if answers differ or the run fails; 2 for bad input, with nothing written.)",
                                   set_up_query};

}  // namespace boxstream::tool
