// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string_view>
#include <thread>

#include "commands/commands.hpp"
#include "inputs/batches.hpp"
#include "inputs/motion.hpp"
#include "peers/peer.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

/// A suite may stand in several rows, each with cases of its own.
struct Suite {
  std::string name;
  std::string description;
  void (*run)(const Options& options, Report& report, Progress& progress);
  std::vector<CaseText> (*texts)() = nullptr;
  std::string cases = {};                              ///< what the texts are of
  bool (*is_case)(const std::string& name) = nullptr;  ///< where the texts do not name all

  bool has_case(const std::string& wanted) const {
    if (is_case) return is_case(wanted);
    const std::vector<CaseText> all = texts();
    return std::any_of(all.begin(), all.end(), [&](const CaseText& each) { return each.name == wanted; });
  }
};

const Suite suites[] = {
    {"batch", "Detector::find_pairs against all peers", run_batch_suite, [] { return texts_of(batches::all()); },
     "batch, scaling, steps and tune", is_batch},
    {"frames", "World from frame to frame against peers that follow moving boxes", run_frames_suite,
     [] { return texts_of(motions()); }, "frames are one of these with a motion, as U:brown", is_frames_case},
    {"small", "the same of few boxes, where what an update costs without any is the most of it", run_small_suite,
     [] { return texts_of(motions()); }, "small are those of frames", is_frames_case},
#ifdef BOXSTREAM_BENCH_BULLET
    {"bullet", "whole worlds on the Bullet adapter and on Bullet's own broad-phases", run_bullet_suite,
     [] { return std::vector<CaseText>{}; },
     "bullet are the scenes in demos/scenes, such as pile and storm, with peers dbvt, dbvt-deferred, sap", is_scene},
#endif
#ifdef BOXSTREAM_BENCH_FCL
    {"fcl", "the FCL manager against every manager of FCL", run_fcl_suite, fcl_case_texts,
     "fcl are a batch with a work, as U:small", is_fcl_case},
    {"users", "worlds like those of users of FCL, against all managers of FCL", run_fcl_users, fcl_user_texts,
     "users, on FCL"},
#endif
#ifdef BOXSTREAM_BENCH_BULLET
    {"users", "worlds like those of users of Bullet, against all broad-phases of Bullet", run_bullet_users,
     bullet_user_texts, "users, on Bullet"},
#endif
    {"mesh", "self-intersections of surfaces and the distance of two, against CGAL's AABB tree", run_mesh_suite,
     mesh_case_texts, "mesh, with peers cgal-tree, cgal-tree-kept, cgal-pmp, three-phases, tree-kept and brute"},
    {"sets", "Detector::find_pairs between two batches, with filters, and of doubles", run_sets_suite, sets_case_texts,
     "sets, with peers block-loop, two-trees, tree-of-few, cgal, embree, by-hand and sorted-sweep"},
    {"many", "Detector::find_pairs of many sets in one call, frame by frame", run_many_suite, many_case_texts,
     "many, with peers calls, calls-kept (all pairs in one array, as boxstream's), worlds and dbvt (one a set)"},
    {"scaling", "Detector::find_pairs over n, threads, all peers, and one radix sort of n keys", run_scaling_suite,
     nullptr, "", is_batch},
#ifdef BOXSTREAM_BENCH_STEPS
    {"steps", "from the paper's program to Detector::find_pairs, step by step", run_steps_suite, nullptr, "", is_batch},
#endif
    {"tune", "the planner's choice against the best of all plans made by hand", run_tune_suite, nullptr, "", is_batch},
};

const struct {
  std::string_view name;
  std::string_view description;
  int (*run)(int argc, char** argv);
} commands[] = {
#ifdef BOXSTREAM_BENCH_PLOT
    {"plot", "draw a file written with --json: plot RESULTS.json OUT.svg", run_plot},
#endif
    {"model", "predictions of a model of the engine's cost, and measurements", run_model},
#ifdef BOXSTREAM_BENCH_NEAR
    {"near", "near neighbours by a Delaunay triangulation, by the algorithm for thick objects and by boxstream",
     run_near},
#endif
    {"large", "searches with less memory than the boxes take, beside searches in memory", run_large},
    {"table", "tables in Markdown from files written with --json: table RESULTS.json... [--into PAGE.md]", run_table},
    {"worst", "search for the batch on which boxstream does worst", run_worst},
};

std::string footer() {
  std::string text = "Suites:\n";
  for (const Suite& suite : suites) text += fmt::format("  {:<8} {}\n", suite.name, suite.description);
  text += "Other commands, with a --help of their own:\n";
  for (const auto& command : commands) text += fmt::format("  {:<8} {}\n", command.name, command.description);
  for (const Suite& suite : suites) {
    if (!suite.texts) continue;
    text += "Cases of " + suite.cases + ":\n";
    for (const CaseText& each : suite.texts()) text += fmt::format("  {:<19} {}\n", each.name, each.description);
  }
  text += "Peers of the other suites (of fcl, FCL's, and fcl-tree-listed and fcl-naive as well):\n ";
  std::string last;
  for (const PeerConfig& peer : make_peers(1))
    if (peer.family != last) text += ' ' + (last = peer.family);
  return text +
         "\nExit code: 0 all pairs equal, or different for a reason that the row gives; 1 some differ; 2 bad arguments";
}

template <class Named>
std::string names(Span<Named> all) {
  std::string text;
  for (const Named& one : all) text += fmt::format(" {}", one.name);
  return text;
}

/// The suites to run, each with the cases that it knows. Throws std::invalid_argument for a case that none knows.
std::vector<std::pair<Suite, Options>> plan(const std::string& wanted, const Options& options) {
  std::vector<std::pair<Suite, Options>> planned;
  std::vector<std::string> unknown = options.cases;
  for (const Suite& suite : suites) {
    if (wanted != "all" && wanted != suite.name) continue;
    Options own = options;
    std::erase_if(own.cases, [&](const std::string& name) { return !suite.has_case(name); });
    std::erase_if(unknown, [&](const std::string& name) { return suite.has_case(name); });
    if (options.cases.empty() || !own.cases.empty()) planned.push_back({suite, own});
  }
  if (!unknown.empty())
    throw std::invalid_argument(fmt::format("no case '{}' in suite {}; batches are{}, motions are{}; --help says more",
                                            unknown.front(), wanted, names(batches::all()), names(motions())));
  return planned;
}

int run_suites(int argc, char** argv) {
  CLI::App app("Times boxstream beside its peers, interleaved in one run, and checks that the pairs are equal.");
  app.footer(footer());

  std::vector<std::string> suite_names{"all"};
  for (const Suite& suite : suites)
    if (suite.name != suite_names.back()) suite_names.push_back(suite.name);

  Options options;
  options.threads = std::max(2u, std::thread::hardware_concurrency());
  std::string suite = "all", json;
  std::vector<double> sizes;
  app.add_option("suite", suite, "which comparisons")->check(CLI::IsMember(suite_names))->capture_default_str();
  app.add_flag("--quick", options.quick, "fewer cases, sizes and rounds: all suites in under three minutes");
  app.add_option("--json", json, "also write the rows to this file");
  app.add_option("--case", options.cases, "cases, as U,D,S or U:brown,P:fall")->delimiter(',');
  app.add_option("--n", sizes, "numbers of boxes, as 1000,1e6; not for bullet")
      ->delimiter(',')
      ->check(CLI::Range(1.0, 1e8));
  app.add_option("--peer", options.peers, "peers, as cgal,sweep,brute")->delimiter(',');
  auto* repeats = app.add_option("--repeats", options.interleaving.repeats, "rounds over a batch (7; 3 with --quick)")
                      ->check(CLI::Range(1, 1000));
  auto* frames = app.add_option("--frames", options.frames, "frames of a moving case (60; 10 with --quick)")
                     ->check(CLI::Range(1, 1000000));
  app.add_option("--threads", options.threads, "where ours or a peer runs on several")
      ->check(CLI::Range(2, 1024))
      ->capture_default_str();
  app.add_option("--seed", options.seed, "of batches and motions")->capture_default_str();
  auto* limit = app.add_option("--limit", options.limit_seconds,
                               "skip a peer predicted to take more seconds a run (10; 0.2 with --quick); of frames, a "
                               "run is filling and three of them")
                    ->check(CLI::PositiveNumber);
  app.add_option("--steps", options.steps, "bullet suite: steps (as the scene says; 120 with --quick)")
      ->check(CLI::Range(1, 1000000));
  if (const auto exit_code = parse(app, argc, argv)) return *exit_code;

  if (options.quick && !*repeats) options.interleaving.repeats = 3;
  if (options.quick && !*limit) options.limit_seconds = 0.2;
  if (options.quick && !*frames) options.frames = 10;
  for (const double n : sizes) options.sizes.push_back(static_cast<std::size_t>(n));

  if (suite == "all" && !options.peers.empty())
    throw std::invalid_argument("--peer needs a suite: each has peers of its own");
  const auto planned = plan(suite, options);
  Report report(describe_machine());
  Progress progress;
  for (const auto& [chosen, own] : planned) chosen.run(own, report, progress);
  report.print_summary();
  if (!json.empty()) report.write_json(json);
  if (report.failed()) std::puts("FAIL: pairs differ");
  return report.failed() ? 1 : 0;
}

int run(int argc, char** argv) {
  for (const auto& command : commands)
    if (argc > 1 && command.name == argv[1]) return command.run(argc - 1, argv + 1);
  return run_suites(argc, argv);
}

}  // namespace

}  // namespace boxstream::bench

int main(int argc, char** argv) {
  try {
    return boxstream::bench::run(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "boxstream_bench: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "boxstream_bench: %s\n", error.what());
    return 1;
  }
}
