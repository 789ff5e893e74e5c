// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "base/output_file.hpp"
#include "base/words.hpp"
#include "boxstream/advice/warnings.hpp"
#include "boxstream/explain/price_list.hpp"
#include "boxstream/explain/tried.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "boxstream/shared/scene_files.hpp"
#include "formats/scene_model/names.hpp"
#include "simulation/effects/plan.hpp"

namespace boxstream::tool {

extern const char* const prices_json;  // made from demos/simulation/effects/prices.json by CMake

namespace {

/// What effects cost where a scene calls for them, by name.
using Prices = std::map<std::string, MeasuredPrice>;

/// As measured last, when demos/simulation/effects/prices.json was written; it is compiled in.
Prices measured_prices() {
  const nlohmann::json document = nlohmann::json::parse(prices_json);
  Prices prices;
  for (const auto& [name, price] : document.at("effects").items())
    prices[name] = {price.at("ns_per_body_step"), price.at("interval_ns").at(0), price.at("interval_ns").at(1)};
  return prices;
}

struct ExplainOptions {
  std::string scene;
  double scale = 1;
  std::optional<std::uint64_t> steps;  // none: as the scene says
  bool tries = false;                  // runs the scene with other settings
  double budget = 30;                  // seconds, for that
  std::string json;                    // empty: none; "-": standard output, in place of the table
};

using effects::Decision;

std::string cost_in(const Prices& prices, const effects::Effect& effect) {
  const auto price = prices.find(effect.name);
  return price == prices.end() ? "-" : cost_text(price->second, effect);
}

std::string table(const scenes::Scene& scene, const effects::Plan& plan, const Prices& prices,
                  const Warnings& warnings) {
  std::string out =
      fmt::format("scene    {}: {}\n\n", files::printable(scene.meta.name), files::printable(scene.meta.about));
  const auto row = [&](const std::string& name, const std::string& on, const std::string& cost,
                       const std::string& why) {
    out += fmt::format("{:<21} {:<4} {:>26}   {}\n", name, on, cost, why);
  };
  row("effect", "", "ns", "why, and what is built for it");
  for (const Decision& decision : plan)
    if (decision.call)
      row(decision.effect->name, "on", cost_in(prices, *decision.effect),
          files::printable(
              fmt::format("{}: {}; {}", decision.call->pointer, decision.call->reason, decision.effect->builds)));
  for (const Decision& decision : plan)
    if (!decision.call)
      row(decision.effect->name, "off", cost_in(prices, *decision.effect),
          fmt::format("would be: {}", decision.effect->builds));
  if (scene.solver.precision == scenes::Precision::doubled)
    out += "\ndouble   /solver/precision: boxstream simulate runs it on the Bullet of double precision.\n";
  if (!warnings.overlap.empty()) out += fmt::format("\noverlap  {}.\n", warnings.overlap);
  for (const std::string& line : warnings.wrong) out += fmt::format("\nwrong    {}\n", files::printable(line));
  for (const HardCase& hard : warnings.hard)
    out += fmt::format(
        "\nhard     {}.\n         {}.\n{}", hard.what, hard.advice,
        hard.scene.empty() ? "" : fmt::format("         One of its kind: boxstream simulate hard/{}\n", hard.scene));
  for (const CoarseStep& coarse : warnings.coarse)
    out += fmt::format("\ncoarse   {}.\n         {}.\n         Measured: {} of docs/{}.md\n", coarse.what,
                       coarse.advice, coarse.known, coarse.page);
  out +=
      "\nns: of a body and step, where a scene calls for it, as measured once on one machine (docs/effects.md);\n"
      "within noise: too little to be measured, rounds lay in this interval; noise: it took less time with it, by so "
      "much, for "
      "reasons of its own scene; saves: that is what it is for; -: not measured. Effects that are off are "
      "not built, not registered and not "
      "called.\n";
  return out;
}

nlohmann::ordered_json document(const scenes::Scene& scene, const effects::Plan& plan, const Prices& prices,
                                const Warnings& warnings) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const Decision& decision : plan) {
    nlohmann::ordered_json row{{"effect", decision.effect->name}, {"on", decision.call.has_value()}};
    if (decision.call) {
      row["pointer"] = decision.call->pointer;
      row["reason"] = decision.call->reason;
    }
    row["about"] = decision.effect->about;
    row["builds"] = decision.effect->builds;
    if (const auto price = prices.find(decision.effect->name); price != prices.end())
      row.update({{"ns_per_body_step", price->second.ns}, {"interval_ns", {price->second.low, price->second.high}}});
    rows.push_back(std::move(row));
  }
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const HardCase& hard : warnings.hard)
    cases.push_back(
        {{"what", hard.what},
         {"advice", hard.advice},
         {"scene", hard.scene.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json("hard/" + hard.scene)}});
  nlohmann::ordered_json deep = nlohmann::ordered_json::array();
  for (const scenes::StartOverlap& overlap : warnings.overlaps.deepest)
    deep.push_back({{"bodies", {overlap.a, overlap.b}}, {"depth_m", overlap.depth}});
  nlohmann::ordered_json coarse = nlohmann::ordered_json::array();
  for (const CoarseStep& each : warnings.coarse)
    coarse.push_back({{"what", each.what},
                      {"advice", each.advice},
                      {each.page == "witnesses" ? "witness" : "closed_form", each.known}});
  return {{"format", 1},
          {"scene", scene.meta.name},
          {"file", scene.file},
          {"precision", scenes::precision_names().at(static_cast<std::size_t>(scene.solver.precision))},
          {"effects", std::move(rows)},
          {"overlaps_at_start", std::move(deep)},
          {"warnings", warnings.wrong},
          {"hard_cases", std::move(cases)},
          {"coarse_steps", std::move(coarse)}};
}

int run_explain(const ExplainOptions& options) {
  scenes::Scene scene = load_scaled(options.scene, options.scale);
  if (options.steps) scene.time.steps = static_cast<int>(*options.steps);
  const effects::Plan plan = effects::plan(scene);
  const Prices prices = measured_prices();
  const Warnings warnings = warnings_of(scene);
  nlohmann::ordered_json plan_json = document(scene, plan, prices, warnings);
  std::string text = table(scene, plan, prices, warnings);
  if (options.tries) {
    if (options.scale != 1 || options.steps)
      throw BadInput("--try runs the scene as it is: not with --scale or --steps");
    Tried tried = try_settings(options.scene, options.budget);
    plan_json["tried"] = std::move(tried.json);
    text += "\n" + tried.text;
  }
  if (!options.json.empty()) files::write_file(options.json, json_dump(plan_json, 2) + "\n");
  if (options.json != "-") print(text);
  return 0;
}

Action set_up_explain(CommandLine& command) {
  const auto options = std::make_shared<ExplainOptions>();
  add_scene(command, options->scene, SceneKind::simulation);
  add_steps(command, options->steps, "As for simulate: what would run is what is explained");
  add_scale(command, options->scale, "As for simulate");
  command.add_flag("--try", options->tries,
                   "Run the scene with other settings, solvers included, and name the cheapest sound one");
  add_budget(command, options->budget, "What --try takes: 90, 90s, 1.5min; default: 30s");
  add_json(command, options->json, "Write the plan");
  return [options] { return run_explain(*options); };
}

}  // namespace

extern const Command explain_command{"explain", "Print which effects a scene calls for, and why",
                                     R"(Examples:
  boxstream explain wall
  boxstream explain hard/chain_40 --try
  boxstream explain my-scene.json --json - | jq '.effects[] | select(.on) | .effect'

An effect is something a world can do: gravity, friction, sweeping of fast bodies, sensors, wind ... A scene is simulated
with those that it calls for, and no others. For each that is on: the first element of the scene that calls for it (a JSON
pointer), and why. Where a scene resembles a world that is known to be hard for its settings, lines say so, and with
which settings scenes like this one held (bench/results/hard-worlds.md; what they cost is that of those scenes); where its steps are too coarse for what is known by closed forms, others
say what gets it right (docs/internals/closed-forms.md). A scene can state what it expects: {"effects": {"require": [...], "forbid": [...]}}.
What holds this very scene, and for what price, is what --try finds: it runs the scene for its whole time, from cheap settings to
expensive ones, against a reference of fine steps, and leaves out what gains energy, loses bodies, pulls joints apart or sinks
in. boxstream simulate --all-effects builds all of them, for comparison.)",
                                     set_up_explain};

}  // namespace boxstream::tool
