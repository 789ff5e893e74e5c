// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

#include "accuracy/usual_knobs.hpp"
#include "base/read_file.hpp"
#include "base/words.hpp"
#include "boxstream/accuracy/accuracy_writers.hpp"
#include "boxstream/accuracy/closed_form.hpp"
#include "boxstream/explain/tried.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/interrupt.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/scene_files.hpp"
#include "boxstream/simulate/json_report.hpp"
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_scene.hpp"

namespace boxstream::tool {
namespace {

struct AccuracyOptions {
  std::string scene;
  std::vector<std::string> knobs;    // "NAME=VALUE,VALUE..."
  std::vector<std::string> metrics;  // empty: penetration and energy_drift
  std::string broadphase = "boxstream";
  std::optional<std::uint64_t> steps;  // none: as the scene says
  double scale = 1;
  int settle = 0;  // steps before anything is measured
  int repeats = 9;
  double budget = 60;                 // seconds
  std::string bound;                  // empty: none
  bool advise = false;                // look for the cheapest sound setting
  std::string body;                   // name or number; empty: none
  std::string joint;                  // number, or names of its bodies; empty: all
  std::optional<double> at;           // seconds: measured then, and no later
  std::string truth;                  // a number, POINTER=NUMBER, a closed form or a CSV file; empty: none
  std::string csv, plot, page, view;  // empty: none
  std::string json;                   // empty: none; "-": standard output, in place of the table
};

/// As many as let walls and towers of the report come to rest.
constexpr int settling_iterations = 200;

/// A word for a shell.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("_-./=,:+%@").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// The command line that makes the same page again, quoted for a shell.
std::string page_command(const AccuracyOptions& options) {
  std::string command = "boxstream accuracy " + quoted(options.scene);
  const auto add = [&](const char* name, const std::string& value) {
    command += fmt::format(" {} {}", name, quoted(value));
  };
  for (const std::string& knob : options.knobs) add("--knob", knob);
  for (const std::string& metric : options.metrics) add("--metric", metric);
  if (options.broadphase != AccuracyOptions().broadphase) add("--broadphase", options.broadphase);
  if (options.steps) add("--steps", fmt::to_string(*options.steps));
  if (options.scale != 1) add("--scale", fmt::to_string(options.scale));
  if (options.settle != 0) add("--settle", fmt::to_string(options.settle));
  add("--repeats", fmt::to_string(options.repeats));
  if (options.budget != AccuracyOptions().budget) add("--budget", fmt::format("{}", options.budget));
  if (!options.bound.empty()) add("--bound", options.bound);
  if (options.advise) command += " --advise";
  if (!options.body.empty()) add("--body", options.body);
  if (!options.joint.empty()) add("--joint", options.joint);
  if (options.at) add("--at", fmt::format("{}", *options.at));
  if (!options.truth.empty()) add("--truth", options.truth);
  add("--page", options.page);
  return command;
}

void take_truth(const AccuracyOptions& options, accuracy::Request& request) {
  if (options.truth.empty()) return;
  if (options.truth.starts_with('/') && options.truth.find('=') != std::string::npos) {
    const std::size_t equals = options.truth.rfind('=');
    const nlohmann::json value = nlohmann::json::parse(options.truth.substr(equals + 1), nullptr, false);
    if (!value.is_number()) throw BadInput("--truth " + options.truth + ": no number behind the =");
    request.measures.insert(request.measures.begin(), accuracy::parse_measure(options.truth.substr(0, equals)));
    request.truth.value = value.get<double>();
    return;
  }
  const nlohmann::json number = nlohmann::json::parse(options.truth, nullptr, false);
  if (number.is_number()) {
    if (options.metrics.empty()) throw BadInput("--truth " + options.truth + ": of which --metric?");
    request.truth.value = number.get<double>();
    return;
  }
  if (const auto known = closed_form(options.truth)) {
    if (options.metrics.empty())
      throw BadInput(fmt::format("--truth {}: of which --metric? It is {:g} {}: {}", options.truth, known->truth,
                                 known->unit, known->about));
    request.truth.value = known->truth;
    return;
  }
  if (!options.truth.ends_with(".csv") && !std::ifstream(options.truth))
    throw BadInput("--truth " + unknown_word("closed form", options.truth, closed_form_names()) +
                   "; or a number, POINTER=NUMBER, FILE.csv");
  std::istringstream file(files::read_file(options.truth, files::most_of_text));
  request.truth.points = accuracy::read_truth(file, options.truth);
  request.measures.insert(request.measures.begin(), accuracy::parse_measure("truth"));
}

/// As many as `--steps` takes.
constexpr std::uint64_t most_steps = 10'000'000;

accuracy::Request request_of(const AccuracyOptions& options) {
  accuracy::Request request;
  request.file = resolve_scene(options.scene, SceneKind::simulation).string();
  request.scene = scenes::parse_json(scenes::read_text_file(request.file), request.file);
  for (const std::string& text : options.knobs) request.knobs.push_back(accuracy::parse_knob(text));
  const std::vector<std::string> usual{"penetration", "energy_drift"};
  for (const std::string& name : options.metrics.empty() ? usual : options.metrics)
    request.measures.push_back(accuracy::parse_measure(name));
  request.broadphase = options.broadphase;
  request.scale = options.scale;
  request.steps = options.steps.value_or(0);
  if (options.settle != 0)
    request.settling = {{{"solver", {{"iterations", settling_iterations}}}},
                        static_cast<std::uint64_t>(options.settle)};
  request.repeats = options.repeats;
  request.budget = options.budget;
  request.compare = true;
  request.body_name = options.body;
  request.joint_name = options.joint;
  request.document = [broadphase = options.broadphase](const scenes::Scene& run) {
    return document_of(run, broadphase);
  };
  request.elsewhere = other_precision();
  request.stop = interrupted;
  const scenes::Scene scene = scenes::parse_scene(request.scene.dump(), request.file);
  note_what_was_read(scene);
  if (options.knobs.empty()) request.knobs = accuracy::usual_knobs(scene, request.elsewhere != nullptr);
  if (options.advise || (options.knobs.empty() && !options.bound.empty())) request.seek.emplace();
  if (request.seek && !options.bound.empty()) request.seek->bound = accuracy::parse_bound(options.bound);
  if (options.at) {
    const double steps = *options.at / scene.time.dt;
    if (!(steps >= 0.5)) throw BadInput(fmt::format("--at {}: before the end of the first step", *options.at));
    if (!(steps <= static_cast<double>(most_steps)))
      throw BadInput(fmt::format("--at {}: more than {} steps of {:g} s", *options.at, most_steps, scene.time.dt));
    if (options.steps) throw BadInput("--at and --steps: one of the two");
    request.steps = static_cast<std::uint64_t>(std::llround(steps));
    for (accuracy::Measure& measure : request.measures)
      if (measure.name.find('.') == std::string::npos) measure.statistic = accuracy::Measure::Statistic::last;
  }
  take_truth(options, request);
  return request;
}

void check_page(const std::string& page) {
  if (page.empty()) return;
  if (!page.ends_with(".html")) throw BadInput(fmt::format("--page {}: the file's name must end in .html", page));
  if (!has_accuracy_page())
    throw BadInput("--page: this boxstream was built without its pages, which take node and npm");
}

int run_accuracy(const AccuracyOptions& options) try {
  AccuracyResult result;
  result.request = request_of(options);
  result.page_command = page_command(options);
  const auto format = checked_format(options.plot);
  check_page(options.page);
  check_view(options.view, result.request);
  OutputFiles files;
  std::ostream *const csv = files.add(options.csv), *const json = files.add(options.json);
  std::ostream *const plot = files.add(options.plot), *const page = files.add(options.page);
  std::ostream* const view = files.add(options.view);

  if (!options.bound.empty()) result.bound = accuracy::parse_bound(options.bound);
  StatusLine status;
  const InterruptCatcher catcher;
  result.sweep = accuracy::run(result.request, [&](const accuracy::Stage& stage) {
    status.run(stage.done + 1, stage.all, stage.seconds_left, stage.what);
  });
  if (result.sweep.rows.empty()) throw BadInput("stopped before anything was measured");
  if (view != nullptr) write_accuracy_view(result.request, *view, status);
  status.clear();
  result.front = front_of(result);
  if (plot != nullptr && judge(result) == nullptr)
    throw BadInput("--plot: no metric applies to this scene: " + notes(result).front().first + " " +
                   notes(result).front().second);

  if (csv != nullptr) *csv << accuracy_csv(result);
  if (json != nullptr) *json << accuracy_json(result);
  if (plot != nullptr) picture::write_plot(accuracy_plot(result), *plot, *format);
  if (page != nullptr) write_accuracy_page(result, *page);
  files.commit();
  if (options.csv != "-" && options.json != "-") print(accuracy_table(result));
  return 0;
} catch (const accuracy::BadKnob& error) {
  throw BadInput(error.what());
}

/// "substeps=", for values to follow.
std::vector<std::string> knobs_to_set() {
  std::vector<std::string> names = accuracy::knob_names();
  for (std::string& name : names) name += '=';
  return names;
}

Action set_up_accuracy(CommandLine& command) {
  const auto options = std::make_shared<AccuracyOptions>();
  add_scene(command, options->scene, SceneKind::simulation);
  command.complete(
      command
          .add_option("--knob", options->knobs,
                      "A value of the scene, and what to set it to; may be repeated; default: what is worth trying")
          ->type_name("NAME=VALUE,VALUE...")
          ->expected(1)
          ->take_all(),
      knobs_to_set);
  command.complete(add_name(command, "--metric", options->metrics,
                            "What to measure; may be repeated; default: penetration, energy_drift")
                       ->expected(1)
                       ->take_all(),
                   accuracy::measure_names);
  take_broadphase(command, add_name(command, "--broadphase", options->broadphase, "{}; default: boxstream"));
  add_steps(command, options->steps, "Of the scene as it is; all settings simulate the same time");
  add_scale(command, options->scale, "As for simulate");
  add_number(command, "--settle", options->settle,
             "Let the scene come to rest in so many steps, with 200 iterations, before anything is measured", 1,
             1000000);
  add_number(command, "--repeats", options->repeats, "Timed runs of each setting, at most; default: 9", 1, 1000);
  add_budget(command, options->budget,
             "For all of it, as far as each setting can be run once: 90, 90s, 1.5min; default: 60s");
  command
      .add_option("--bound", options->bound,
                  "Find the cheapest setting whose first metric is off by no more: 5mm, 0.1%, 2")
      ->type_name("BOUND");
  command.add_flag("--advise", options->advise, "Find the cheapest sound setting, and do not try all");
  command.add_option("--body", options->body, "Body of the metrics x, y, z, speed and spin: its name, or its number")
      ->type_name("NAME");
  command
      .add_option("--joint", options->joint,
                  "Joint of the metrics joint_error and joint_angle: its bodies A,B, or its number; default: all")
      ->type_name("NAME");
  command.add_option("--at", options->at, "Measure at this time, in seconds, and end there")->type_name("SECONDS");
  command
      .add_option("--truth", options->truth,
                  "What the first metric should be: a number, or the name of a closed form of "
                  "docs/internals/closed-forms.md; or "
                  "POINTER=NUMBER of the JSON of simulate; or FILE.csv of seconds,x,y,z of --body")
      ->type_name("TRUTH");
  add_file(command, "--csv", options->csv, "Write the table; - is standard output");
  add_json(command, options->json);
  add_file(command, "--plot", options->plot, "Draw time against the first metric: FILE.svg or FILE.png");
  add_file(command, "--page", options->page, "Make a page with plots and tables, and a choice by bounds: FILE.html");
  add_file(command, "--view", options->view,
           "Make a page that plays the first and the last setting beside each other: FILE.html");
  return [options] { return run_accuracy(*options); };
}

}  // namespace

extern const Command accuracy_command{"accuracy", "Show what accuracy of a scene costs in time",
                                      R"(Examples:
  boxstream accuracy my-scene.json --advise
  boxstream accuracy hard/chain_40 --metric trajectory --bound 5mm --page chain.html
  boxstream accuracy pile --knob substeps=1,2,4,8 --metric penetration
  boxstream accuracy pile --knob substeps=1,4 --repeats 1 --view substeps.html
  boxstream accuracy my-scene.json --knob dt=1/60,1/120,1/240 --knob iterations=5,10,20 --plot front.svg
  boxstream accuracy my-scene.json --body ball --metric y --at 2.5 --truth 0.2929

A knob is a key of the scene's blocks time and solver (bounces, cache_friction, contact_erp, dt, erp,
friction_directions, iterations, margin of shapes, precision, residual, slop, solver, split_impulse, step, substeps,
warmstart) or a JSON pointer to any other value (/materials/NAME/friction; "*" is every element: /bodies/*/ccd). Several
knobs: all combinations. Without a knob, and with --advise or --bound: solvers, bounces, iterations and substeps that
are worth trying on the scene, and, one at a time, precision, margin and step.

Metrics are those of checks, "penetration", momentum_drift, angular_momentum_drift, energy_change (with its sign),
joint_error (m), joint_angle (degrees), mean_square_penetration (m^2), height_loss (against gravity), tunnelled (share
out of bounds), collapse_time (s, until a tenth of the height is lost), stands, repeatable; of --body x, y, z, speed, spin; and against
the reference trajectory (m), orientation (degrees), agrees_for (s, until contacts differ), trajectory_until (m, until
then). The worst of all steps counts, unless .p95, .mean, .last or .integral (over time) stands behind the name. Smaller
is better, but for collapse_time, stands, agrees_for, repeatable and finite; energy_change is best near 0; of places,
speeds, energy and momentum what is nearest to the reference. A JSON pointer is a number in what simulate --json says of
the run: /worlds/0/energy/lost_j.

The reference is the scene in finer and finer steps, with solvers that do not limit it; by how much its last run may be off
is estimated from those before, and smaller errors are equal. Where finer steps part, it says when.

Bodies that are placed above what they land on fall first, alike at all settings, and a height_loss is then that of the
fall. --settle STEPS measures from where bodies are at rest; the scene is refused if one of them still moves.

Every setting simulates the same time: once to be measured, and up to --repeats times for the clock, settings taking turns, as
long as intervals overlap and --budget lasts. The first setting is timed twice, as a control: differences below that
between the two are not significant. A star marks sound settings that no other sound one beats in both time and the
first metric that applies; "!" those that gain energy, break a check, lose a body or a joint, fall, or go elsewhere than
the reference, whatever their numbers. Ctrl-C ends with what was measured.)",
                                      set_up_accuracy};

}  // namespace boxstream::tool
