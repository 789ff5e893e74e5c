// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream explain wall
  boxstream explain my-scene.json --json - | jq '.effects[] | select(.on) | .effect'

An effect is something a world can do: gravity, friction, sweeping of fast bodies, sensors, wind ... A scene is simulated
with those that it calls for, and no others. For each that is on: the first element of the scene that calls for it (a JSON
pointer), and why. A scene can state what it expects: {"effects": {"require": [...], "forbid": [...]}}.
boxstream simulate --all-effects builds all of them, for comparison.)";

}  // namespace

void add_explain(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<ExplainOptions>();
  CLI::App* const command = app.add_subcommand("explain", "Say which effects a scene calls for, and why");
  command->add_option("SCENE", options->scene, "Scene file or name")->required();
  add_steps(*command, options->steps, "As for simulate: what would run is what is explained");
  add_scale(*command, options->scale, "As for simulate");
  command->add_option("--json", options->json, "Write the plan; - is standard output")->type_name("FILE");
  command->footer(help);
  choose(*command, chosen, options, explain_command);
}

}  // namespace boxstream::tool
