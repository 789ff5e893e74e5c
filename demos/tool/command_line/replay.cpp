// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream simulate pile --log pile.bsrec
  boxstream replay pile.bsrec --broadphase dbvt --compare sap
  boxstream replay pile.bsrec --dump | less

Makes the calls that a world made to its broad-phase, without the world. After each batch (calculateOverlappingPairs)
these must be the same sets: the pairs of each broad-phase whose boxes overlap (some hold near misses beside them), those
of an independent search, and those that the recording has a hash of. Hits of box queries likewise, but for the
recording. The first batch where they differ is printed, and the first pair with its boxes.

A program that crashes while it records leaves a file that is cut off (of simulate: FILE.NUMBER.part), with all batches
up to then: replay it with --partial.

Times are those of all calls of a broad-phase: boxes, queries and batches.

Exit code: 0; 1 if something differs; 2 for bad input: a file that is no recording, or broken.)";

}  // namespace

void add_replay(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<ReplayOptions>();
  CLI::App* const command =
      app.add_subcommand("replay", "Make recorded calls to a broad-phase, and find the first wrong pair");
  command->add_option("FILE", options->file, "Recording (simulate --log); - is standard input")->required();
  command->add_option("--broadphase", options->broadphase, "As for simulate; default: boxstream")->type_name("NAME");
  command->add_option("--compare", options->compare, "Replay on this one too")->type_name("NAME");
  command->add_option("--json", options->json, "Write the result; - is standard output")->type_name("FILE");
  command->add_flag("--partial", options->partial, "A file that is cut off: replay what is there");
  command->add_flag("--dump", options->dump, "Print the calls, one a line, and replay nothing");
  last_counts(*command, {"--broadphase", "--compare", "--json"});
  command->footer(help);
  choose(*command, chosen, options, replay_command);
}

}  // namespace boxstream::tool
