// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {
namespace {

constexpr const char* help = R"(Examples:
  boxstream prices --quick
  boxstream prices --json demos/effects/prices.json --into docs/effects.md

For each effect two worlds take turns, step by step: the scene that calls for it (boxstream simulate effects/NAME), many
times side by side, with it and without it. Then a scene that does not call for it, with it built all the same and
without. What is shown is the median difference, for each body that is not fixed. Wants a machine with nothing else to
do.)";

}  // namespace

void add_prices(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<PricesOptions>();
  CLI::App* const command = app.add_subcommand("prices", "Measure what each effect costs, and what if uncalled");
  command->add_flag("--quick", options->quick, "A first look, in seconds");
  command->add_option("--json", options->json, "Write them for explain to show; - is standard output")
      ->type_name("FILE");
  command->add_option("--into", options->into, "Write the table into a Markdown page, between its marks")
      ->type_name("FILE");
  command->footer(help);
  choose(*command, chosen, options, prices_command);
}

}  // namespace boxstream::tool
