// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream simulate pile
  boxstream simulate pile --compare dbvt --picture pile.png
  boxstream simulate my-scene.json --broadphase sap --steps 200 --json - | jq .worlds[0].summary
  boxstream simulate pile --view pile.html --record pile.glb --trace pile-trace.json

SCENE is a file, or the name of a scene that comes with the tool (boxstream list).
Broad-phases: boxstream; Bullet's own dbvt (btDbvtBroadphase), dbvt-deferred (the same, collecting pairs once a step),
sap (bt32BitAxisSweep3) and simple (btSimpleBroadphase: quadratic).

Times are processor time of one thread, or elapsed time where the scene has several. "broad-phase" is updateAabbs +
calculateOverlappingPairs, since some do their work in one and some in the other; "dispatch" is
dispatchAllCollisionPairs, which pays for false pairs.

--log records the world asked for, not the one it is compared with. Writing is part of its broad-phase times then.
--record and --view show that world too, outside the times; --trace has all worlds.

--compare steps two worlds side by side, one step each in turn. They drift apart after a while, because the order of
pairs is the order of contacts in the solver; so pair counts are given for both. "pairs equal: yes" means: in every step
and in both worlds, the other broad-phase, fed with exactly the same boxes, found the same set of overlapping pairs, and
so did an independent search. (Near misses that dbvt and sap hold beside them are sorted out by a test of the boxes.)

Exit code: 0; 1 if pairs differ or the run fails; 2 for bad input, with nothing written.)";

}  // namespace

void add_simulate(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<SimulateOptions>();
  CLI::App* const command = app.add_subcommand("simulate", "Run a scene on Bullet, headless, and time its broad-phase");
  command->add_option("SCENE", options->scene, "Scene file or name")->required();
  command->add_option("--broadphase", options->broadphase, "boxstream, dbvt, dbvt-deferred, sap or simple")
      ->type_name("NAME");
  command->add_option("--compare", options->compare, "Run the same scene on this one beside it, and compare pairs")
      ->type_name("NAME");
  add_steps(*command, options->steps, "Number of steps; default: as the scene says");
  command->add_option("--json", options->json, "Write everything that was measured; - is standard output")
      ->type_name("FILE");
  command->add_option("--picture", options->picture, "Draw the result: FILE.png or FILE.svg")->type_name("FILE");
  add_scale(*command, options->scale, "About this many times as many generated bodies; default: 1");
  command
      ->add_option("--record", options->record,
                   "Write FILE.glb, an animation (glTF 2.0), or FILE.aabbs, the boxes of all objects in each step")
      ->type_name("FILE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--csv", options->csv,
                   "Write a table of each step: pairs, times, energy, penetration ...; - is standard output")
      ->type_name("FILE");
  command->add_option("--log", options->log, "Record the calls to the broad-phase, for replay")->type_name("FILE");
  command->add_option("--view", options->view, "Make a page that plays the run in a browser: FILE.html")
      ->type_name("FILE");
  command->add_option("--trace", options->trace, "Write the times for Perfetto or chrome://tracing: FILE.json")
      ->type_name("FILE");
  command
      ->add_option("--record-every", options->record_every,
                   "Keep every Nth step in animations; default: as many as fit in 1 GB")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000));
  command
      ->add_option("--view-every", options->view_every,
                   "Keep every Nth step in the page; default: as many as fit in 60 MB")
      ->type_name("N")
      ->check(CLI::Range(1, 10'000'000));
  CLI::Option* const all_effects =
      command->add_flag("--all-effects", options->all_effects, "Build what the scene does not call for too");
  command
      ->add_flag("--only-called", options->only_called, "Build what the scene calls for and nothing else; the default")
      ->excludes(all_effects);
  command->add_flag("--outputs-anywhere", options->outputs_anywhere,
                    "Let the scene's outputs block name files outside of the current folder");
  last_counts(*command, {"--broadphase", "--compare", "--steps", "--scale", "--json", "--picture", "--log", "--csv",
                         "--view", "--trace", "--record-every", "--view-every"});
  command->footer(help);
  choose(*command, chosen, options, simulate_command);
}

}  // namespace boxstream::tool
