// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "base/read_file.hpp"
#include "base/words.hpp"
#include "boxstream/advice/warnings.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/output_files.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/run.hpp"
#include "boxstream/shared/scene_files.hpp"
#include "boxstream/simulate/json_report.hpp"
#include "boxstream/simulate/recordings.hpp"
#include "boxstream/simulate/reports.hpp"
#include "boxstream/simulate/simulate.hpp"
#include "boxstream/simulate/step_files.hpp"
#include "boxstream/simulate/summary.hpp"
#include "formats/scene_model/names.hpp"
#include "formats/scene_model/scene.hpp"
#include "pictures/drawing/poster.hpp"
#include "simulation/engine/row_solver.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::tool {
namespace {

/// A scene may be from anywhere, and must not choose files of its user's to be replaced.
void check_is_here(const SimulateOptions& options, const scenes::Scene& scene, const std::string& file) {
  if (file.empty() || options.outputs_anywhere || files::is_below(".", file)) return;
  throw BadInput(fmt::format(
      "{}: /outputs: {} is not below the current folder, as outputs that a scene names must be; --outputs-anywhere "
      "allows it",
      scene.file, file));
}

void choose(std::string& option, std::string& output) {
  if (option.empty())
    option = output;
  else
    output = option;
}

/// What the command line and the scene's `outputs` block ask for together: recordings of both; of a page, a trace, a
/// table and a log of calls, which a run has one of, the command line's. They are entered in the scene, so that its
/// plan has them. Throws BadInput if the scene alone asks for two logs, or for a file outside of the current folder
/// without permission.
SimulateOptions with_outputs(const SimulateOptions& options, scenes::Scene& scene) {
  SimulateOptions wanted = options;
  scenes::Outputs& outputs = scene.outputs;
  std::string log;
  for (const std::string& file : outputs.record) {
    check_is_here(options, scene, file);
    if (!file.ends_with(".bsrec")) {
      wanted.record.push_back(file);
      continue;
    }
    if (!log.empty())
      throw BadInput(fmt::format("{}: /outputs/record: {} and {}: a run has one log", scene.file, log, file));
    log = file;
  }
  // What the command line says instead is the user's own choice.
  if (options.view.empty()) check_is_here(options, scene, outputs.view);
  if (options.trace.empty()) check_is_here(options, scene, outputs.trace);
  if (options.csv.empty()) check_is_here(options, scene, outputs.csv);
  choose(wanted.log, log);
  choose(wanted.view, outputs.view);
  choose(wanted.trace, outputs.trace);
  choose(wanted.csv, outputs.csv);
  outputs.record = wanted.record;
  if (!wanted.log.empty()) outputs.record.push_back(wanted.log);
  return wanted;
}

/// Becomes the program of worlds in double precision, which reads the same command line; both precisions of Bullet have
/// the same names, so that they cannot be in one. It is beside this one, or in ../libexec/boxstream. Throws BadInput if
/// it is in neither.
void run_in_double() {
  std::fflush(nullptr);
  const std::filesystem::path here = executable_directory();
  for (const std::filesystem::path& place : {here, here / ".." / "libexec" / "boxstream"})
    execv((place / "boxstream-double").c_str(), given_arguments());
  throw BadInput(
      "--precision double: boxstream-double, the part of this tool that has worlds of double precision, is not "
      "installed; it is built where Bullet is there in both precisions");
}

/// The place of what `option` gives among those that are `known`.
template <class Kind>
Kind kind_of(const char* option, const char* noun, const std::string& name, const std::vector<std::string>& known) {
  const auto found = std::find(known.begin(), known.end(), name);
  if (found == known.end()) throw BadInput(fmt::format("{}: {}", option, unknown_word(noun, name, known)));
  return static_cast<Kind>(found - known.begin());
}

/// Once, however often it was.
void say_what_was_handed_back(const scenes::Scene& scene, const WorldRun& world) {
  const std::uint64_t islands = world.simulation->solver_rows().handed_back;
  if (islands == 0) return;
  remark(
      fmt::format("{}: {} times an island had more than {} rows, or rows without a solution, and was left to "
                  "sequential impulses",
                  scenes::solver_names().at(static_cast<std::size_t>(scene.solver.kind)), islands,
                  scenes::most_rows(scene.solver.kind)));
}

int run_simulate(const SimulateOptions& given) {
  // Everything the user may have got wrong is found out before the first step.
  const auto format = checked_format(given.picture);
  if (given.log == "-") throw BadInput("--log -: a recording is a file");
  if (given.states == "-") throw BadInput("--states -: it is a file, beside the table of the run");
  for (const std::string& file : given.record)
    if (!file.ends_with(".aabbs") && !file.ends_with(".glb"))
      throw BadInput(fmt::format("--record {}: expected a file FILE.aabbs or FILE.glb", file));
  scenes::Scene scene = load_scaled(given.scene, given.scale);
  if (!given.solver.empty())
    scene.solver.kind = kind_of<scenes::SolverKind>("--solver", "solver", given.solver, scenes::solver_names());
  if (!given.precision.empty())
    scene.solver.precision =
        kind_of<scenes::Precision>("--precision", "precision", given.precision, scenes::precision_names());
  if (scene.solver.precision == scenes::Precision::doubled && scenes::precision_here == scenes::Precision::single)
    run_in_double();
  const SimulateOptions options = with_outputs(given, scene);
  // A scene that is run for longer or shorter may call for other effects.
  if (options.steps) scene.time.steps = static_cast<int>(*options.steps);
  const auto steps = static_cast<std::uint64_t>(scene.time.steps);
  const auto extent = options.all_effects ? effects::Extent::all : effects::Extent::only_called;
  effects::plan(scene, extent);  // throws if the scene's wishes about effects are not met
  OutputFiles files;
  std::optional<LogFile> log_file;  // outlives the world that it records
  std::vector<std::unique_ptr<AabbsFile>> boxes;
  std::ostream *const json = files.add(options.json), *const picture = files.add(options.picture);
  std::ostream* const events = files.add(options.events);
  const std::string broadphase = options.broadphase.value_or(scene.broadphase.kind);
  if (!options.log.empty()) log_file.emplace(options.log, scene, broadphase);
  Recordings recordings(options);
  std::vector<std::vector<Monitor*>> monitors = recordings.monitors();
  for (const std::string& file : options.record) {
    if (!file.ends_with(".aabbs")) continue;
    boxes.push_back(std::make_unique<AabbsFile>(file));
    monitors.front().push_back(boxes.back().get());
  }
  std::optional<CsvFile> table;
  if (!options.csv.empty()) monitors.front().push_back(&table.emplace(options.csv));

  std::optional<StatesFile> states;
  if (!options.states.empty()) monitors.front().push_back(&states.emplace(options.states));

  const std::vector<std::string> warnings = warnings_of(scene).lines();
  for (const std::string& line : warnings) remark(files::printable(line));
  if (options.strict && !warnings.empty())
    throw std::runtime_error(
        fmt::format("--strict: {}; nothing was run",
                    warnings.size() == 1 ? "a warning" : fmt::format("{} warnings", warnings.size())));

  StatusLine status;
  const RunResult result = run(scene, broadphase, options.compare, steps, status,
                               log_file ? log_file->wrap() : scenes::Simulation::Wrap{}, extent, monitors);

  if (log_file) log_file->finish();
  for (const auto& each : boxes) each->finish();
  if (table) table->write(result);
  if (json != nullptr) *json << result_json(scene, result);
  if (events != nullptr) *events << events_table(scene, result);
  if (picture != nullptr) {
    status.say("drawing");
    picture::write_poster(result_poster(scene, result), *picture, *format);
  }
  status.say("writing recordings");
  recordings.write(scene, result);
  status.clear();
  files.commit();
  if (log_file) log_file->commit();
  if (table) table->commit();
  if (states) states->commit();
  for (const auto& each : boxes) each->commit();
  recordings.commit();
  recordings.say_what_is_left_out();
  for (const WorldRun& world : result.worlds)
    if (const std::string lost = lost_time(world.steps); !lost.empty())
      remark(result.is_comparison() ? world.broadphase + ": " + lost : lost);
  const std::string gained = gained_energy(*result.worlds.front().simulation);
  const std::string doubted = doubts(result.worlds.front());
  if (!gained.empty()) remark(gained);
  if (!doubted.empty()) remark("unsound: " + doubted);
  for (const WorldRun& world : result.worlds) say_what_was_handed_back(scene, world);
  if (options.json != "-" && options.csv != "-" && options.events != "-") print(result_table(scene, result));

  if (!result.first_difference.empty()) throw std::runtime_error("pairs differ: " + result.first_difference);
  if (const std::string failed = first_failed_check(scene, result); !failed.empty()) throw std::runtime_error(failed);
  for (const WorldRun& world : result.worlds)
    if (!world.simulation->is_finite())
      throw std::runtime_error(fmt::format("the world on {} has coordinates that are not finite", world.broadphase));
  if (options.strict && !(gained + doubted).empty())
    throw std::runtime_error("--strict: the run is not sound: " + (doubted.empty() ? gained : doubted));
  return 0;
}

Action set_up_simulate(CommandLine& command) {
  const auto options = std::make_shared<SimulateOptions>();
  add_scene(command, options->scene, SceneKind::simulation);
  take_broadphase(command, add_name(command, "--broadphase", options->broadphase, "{}; default: as the scene says"));
  take_broadphase(command, add_name(command, "--compare", options->compare,
                                    "Run the same scene on this one beside it, and compare pairs"));
  command.complete(
      add_name(command, "--solver", options->solver, "Solve contacts and joints with this; default: as the scene says"),
      [] { return scenes::solver_names(); });
  command.complete(add_name(command, "--precision", options->precision,
                            "Compute with single or double precision; default: as the scene says"),
                   [] { return scenes::precision_names(); });
  add_steps(command, options->steps, "Number of steps; default: as the scene says");
  add_json(command, options->json);
  add_file(command, "--picture", options->picture, "Draw the result: FILE.png or FILE.svg");
  add_scale(command, options->scale, "About this many times as many generated bodies; default: 1");
  add_file(command, "--record", options->record,
           "Write FILE.glb, an animation (glTF 2.0), or FILE.aabbs, the boxes of all objects in each step")
      ->expected(1)
      ->take_all();
  add_file(command, "--csv", options->csv,
           "Write a table of each step: pairs, times, energy, penetration ...; - is standard output");
  add_file(command, "--states", options->states,
           "Write a table of where each body is, how it is turned, moves and spins, after each step; FILE.csv");
  add_file(command, "--events", options->events,
           "Write a table of what enters and leaves the scene's sensors; - is standard output");
  add_file(command, "--log", options->log, "Record the calls to the broad-phase, for replay");
  add_file(command, "--view", options->view, "Make a page that plays the run in a browser: FILE.html");
  add_file(command, "--trace", options->trace, "Write the times for Perfetto or chrome://tracing: FILE.json");
  add_number(command, "--record-every", options->record_every,
             "Keep every Nth step in animations; default: as many as fit in 1 GB", 1, 10'000'000);
  add_number(command, "--view-every", options->view_every,
             "Keep every Nth step in the page; default: as many as fit in 60 MB", 1, 10'000'000);
  add_number(command, "--view-bodies", options->view_bodies,
             "Show at most N bodies in the page, those nearest at first and a sample; default: 100000", 1, 100'000'000);
  CLI::Option* const all_effects =
      command.add_flag("--all-effects", options->all_effects, "Build what the scene does not call for too");
  command
      .add_flag("--only-called", options->only_called, "Build what the scene calls for and nothing else; the default")
      ->excludes(all_effects);
  command.add_flag("--strict", options->strict,
                   "Exit with 1 before a run that is warned of, or after one that went wrong");
  command.add_flag("--outputs-anywhere", options->outputs_anywhere,
                   "Let the scene's outputs block name files outside of the current folder");
  command.last_counts({"--broadphase", "--compare", "--solver", "--precision", "--steps", "--scale", "--json",
                       "--picture", "--log", "--csv", "--states", "--events", "--view", "--trace", "--record-every",
                       "--view-every", "--view-bodies"});
  return [options] { return run_simulate(*options); };
}

}  // namespace

extern const Command simulate_command{"simulate", "Run a scene on Bullet, headless, and time its broad-phase",
                                      R"(Examples:
  boxstream simulate pile
  boxstream simulate pile --compare dbvt --picture pile.png
  boxstream simulate my-scene.json --broadphase sap --steps 200 --json - | jq .worlds[0].summary
  boxstream simulate pile --view pile.html --record pile.glb --trace pile-trace.json

SCENE is a file, or the name of a scene that comes with the tool (boxstream list).
Broad-phases: boxstream; hybrid (the same by the streamed segment tree of the paper alone, a batch of all boxes in each
step); Bullet's own dbvt (btDbvtBroadphase), dbvt-deferred (the same, collecting pairs once a step),
sap (bt32BitAxisSweep3) and simple (btSimpleBroadphase: quadratic).

Solvers: sequential_impulses (Bullet's usual one), nncg (the same with conjugate gradients), and those of the matrix of
each island: dantzig and lemke, which are exact and take cubic time, and projected_gauss_seidel. With multibodies,
joints that form trees become coordinates, and contacts are solved as usual.

--precision double runs the same world on the Bullet of double precision, in the program boxstream-double, which comes
with this one: for worlds far from the origin, or of bodies small against their place. docs/effects.md says what it costs.

Times are processor time of one thread, or elapsed time where the scene has several. "broad-phase" is updateAabbs +
calculateOverlappingPairs, since some do their work in one and some in the other; "dispatch" is
dispatchAllCollisionPairs, whose time grows with false pairs.

--log records the first world, not the one it is compared with. Writing is part of its broad-phase times then.
--record shows that world too, outside the times; --view and --trace have all worlds.

--compare steps two worlds side by side, one step each in turn. They drift apart after a while, because the order of
pairs is the order of contacts in the solver; so pair counts are given for both. "pairs equal: yes" means: in every step
and in both worlds, the other broad-phase, fed with exactly the same boxes, found the same set of overlapping pairs, and
so did an independent search. (Near misses that others than simple hold as well are removed by a test of the boxes.)

Before a run, a line for each thing that the scene's settings are known to get wrong, as boxstream explain has them. At its
end, whatever the scene: the deepest penetration, the widest gap of a joint, energy gained that no work explains, bodies out
of the world's bounds. --strict makes either a failure.

Exit code: 0; 1 if pairs differ or the run fails; 2 for bad input, with nothing written.)",
                                      set_up_simulate};

}  // namespace boxstream::tool
