// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream accuracy pile --knob substeps=1,2,4,8 --metric penetration
  boxstream accuracy my-scene.json --knob dt=1/60,1/120,1/240 --knob iterations=5,10,20 --plot front.svg
  boxstream accuracy hard/chain_40 --knob iterations=10,20,40,80 --knob substeps=1,4 --metric trajectory

A knob is a key of the scene's blocks time and solver (cache_friction, contact_erp, dt, erp, friction_directions,
iterations, residual, slop, split_impulse, substeps, warmstart) or a JSON pointer to any other value
(/bodies/0/friction; "*" is every element: /bodies/*/ccd). Several knobs: all combinations.

Metrics are those of checks, "penetration", momentum_drift, angular_momentum_drift, energy_change (with its sign),
joint_error (m), joint_angle (degrees), mean_square_penetration (m^2), height_loss, tunnelled (share out of bounds),
collapse_time (s, until a tenth of the height is lost), stands, repeatable; and against a run with 64 substeps:
trajectory (m), orientation (degrees), agrees_for (s, until contacts differ), trajectory_until (that time). The worst of
all steps counts, unless .p95, .mean, .last or .integral (over time) stands behind the name.

Every setting simulates the same time: once to be measured, and --repeats times for the clock, settings taking turns. The
first setting has a twin that is timed like all others: what differs by less than the two do is not told apart. A star
marks settings that no other beats in both time and the first metric. A run that fails is shown as failed.)";

}  // namespace

void add_accuracy(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<AccuracyOptions>();
  CLI::App* const command = app.add_subcommand("accuracy", "Show what accuracy of a scene costs in time");
  command->add_option("SCENE", options->scene, "Scene file or name")->required();
  command->add_option("--knob", options->knobs, "A value of the scene, and what to set it to; may be repeated")
      ->type_name("NAME=VALUE,VALUE...")
      ->required()
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--metric", options->metrics, "What to measure; may be repeated; default: penetration, energy_drift")
      ->type_name("NAME")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--broadphase", options->broadphase, "As for simulate; default: boxstream")->type_name("NAME");
  add_steps(*command, options->steps, "Of the scene as it is; all settings simulate the same time");
  add_scale(*command, options->scale, "As for simulate");
  command->add_option("--repeats", options->repeats, "Timed runs of each setting; default: 9")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command->add_option("--csv", options->csv, "Write the table; - is standard output")->type_name("FILE");
  command->add_option("--json", options->json, "Write everything that was measured; - is standard output")
      ->type_name("FILE");
  command->add_option("--plot", options->plot, "Draw time against the first metric: FILE.svg or FILE.png")
      ->type_name("FILE");
  command->footer(help);
  choose(*command, chosen, options, accuracy_command);
}

}  // namespace boxstream::tool
