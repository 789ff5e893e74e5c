// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include "scene/pair_check.hpp"
#include "scene/scene.hpp"
#include "scene/simulation.hpp"
#include "suites.hpp"

namespace boxstream::bench {

namespace {

/// Bodies are created in the first steps of a broad-phase's life, whose cost is not that of a frame.
constexpr int warm_up_steps = 5;

/// Every so many steps each world's pairs are checked; the oracle spoils the caches, so such steps are not timed.
constexpr int check_interval = 20;

/// With fewer uninterrupted steps than this, medians are taken over all steps, and the rows say so.
constexpr std::size_t enough_steps = 20;

struct StepTimes {
  double broadphase_ms;  // updateAabbs + calculateOverlappingPairs + dispatch
  double whole_ms;
};

/// One scene on one broad-phase, with what its steps took. Worlds of the same scene drift apart, because the order of
/// pairs decides the order of constraints: so each is held against its own oracle, not against another world.
class TimedWorld {
 public:
  TimedWorld(const scenes::Scene& scene, const std::string& broadphase) : simulation_(scene, broadphase) {
    simulation_.set_after_pairs([this] {
      if (check_this_step_ && difference_.empty()) difference_ = scenes::check_pairs(simulation_);
    });
  }

  void step(bool check) {
    check_this_step_ = check;
    scenes::StepOptions nothing_extra;
    nothing_extra.events = nothing_extra.exact_pairs = nothing_extra.hash = false;
    const InterruptionWatch watch;
    const scenes::StepResult result = simulation_.step(nothing_extra);
    interrupted_ = watch.interrupted();
    pairs_ = result.pairs;
    times_ = {result.broadphase_ms + result.dispatch_ms, result.step_ms};
  }

  /// Of the last step.
  bool interrupted() const { return interrupted_; }
  StepTimes times() const { return times_; }
  std::uint64_t pairs() const { return pairs_; }

  std::size_t objects() const { return simulation_.objects().size(); }
  const std::string& name() const { return simulation_.broadphase_name(); }
  const std::string& difference() const { return difference_; }

 private:
  scenes::Simulation simulation_;
  bool check_this_step_ = false;
  bool interrupted_ = false;
  std::string difference_;
  std::uint64_t pairs_ = 0;
  StepTimes times_{};
};

/// A step of all worlds, one after the other.
struct Round {
  std::vector<StepTimes> times;
  bool interrupted = false;
};

Series series_of(const std::vector<Round>& rounds, std::size_t world, double StepTimes::*part) {
  std::vector<double> samples;
  for (const Round& round : rounds) samples.push_back(round.times[world].*part);
  return summarize(std::move(samples));
}

Row compare(const std::string& case_name, const TimedWorld& ours, const TimedWorld& peer, const Series& our_times,
            const Series& peer_times) {
  Row row;
  row.suite = "bullet";
  row.clock = "wall";
  row.case_name = case_name;
  row.n = ours.objects();
  row.peer = peer.name();
  row.k = ours.pairs();
  row.ours_ms = our_times.median;
  row.ours_min = our_times.min;
  row.peer_ms = peer_times.median;
  row.peer_min = peer_times.min;
  row.pairs_equal = ours.difference().empty() && peer.difference().empty();
  return row;
}

std::string scene_path(const std::string& name) {
  return fmt::format("{}/{}.json", BOXSTREAM_SCENES_DIR, name);
}

void run_scene(const std::string& name, const Options& options, Report& report, Progress& progress) {
  const scenes::Scene scene = scenes::load_scene(scene_path(name));
  std::vector<std::string> broadphases = options.peers;
  if (broadphases.empty()) broadphases = {"dbvt", "dbvt-deferred"};
  broadphases.insert(broadphases.begin(), "boxstream");

  std::vector<std::unique_ptr<TimedWorld>> worlds;
  for (const std::string& broadphase : broadphases) worlds.push_back(std::make_unique<TimedWorld>(scene, broadphase));

  std::vector<Round> rounds;
  const int steps = options.steps > 0 ? options.steps : options.quick ? 120 : scene.time.steps;
  for (int step = 0; step < steps; ++step) {
    progress.show(fmt::format("bullet {}: step {} of {}", name, step + 1, steps));
    const bool check = step % check_interval == check_interval - 1 || step + 1 == steps;
    // Each world goes first in turn, so that none always follows the same neighbour.
    for (std::size_t i = 0; i < worlds.size(); ++i)
      worlds[(i + static_cast<std::size_t>(step)) % worlds.size()]->step(check);
    if (step < warm_up_steps || check) continue;
    Round& round = rounds.emplace_back();
    for (const auto& world : worlds) {
      round.times.push_back(world->times());
      round.interrupted = round.interrupted || world->interrupted();
    }
  }
  progress.clear();

  std::string note;
  const auto quiet = std::count_if(rounds.begin(), rounds.end(), [](const Round& r) { return !r.interrupted; });
  if (static_cast<std::size_t>(quiet) >= enough_steps)
    std::erase_if(rounds, [](const Round& r) { return r.interrupted; });
  else
    note = fmt::format("busy machine: only {} of {} steps ran uninterrupted", quiet, rounds.size());

  for (const auto& world : worlds)
    if (!world->difference().empty()) fmt::print("FAIL: {} on {}: {}\n", name, world->name(), world->difference());
  const TimedWorld& ours = *worlds.front();
  const struct {
    std::string case_name;
    double StepTimes::*part;
  } parts[] = {{name, &StepTimes::broadphase_ms}, {name + ":step", &StepTimes::whole_ms}};
  for (std::size_t i = 1; i < worlds.size(); ++i)
    for (const auto& [case_name, part] : parts) {
      Row row = compare(case_name, ours, *worlds[i], series_of(rounds, 0, part), series_of(rounds, i, part));
      row.note = note;
      report.add(std::move(row));
    }
}

}  // namespace

bool is_scene(const std::string& name) {
  return std::filesystem::exists(scene_path(name));
}

void run_bullet_suite(const Options& options, Report& report, Progress& progress) {
  for (const std::string& name : options.cases.empty() ? std::vector<std::string>{"pile", "storm"} : options.cases)
    run_scene(name, options, report, progress);
}

}  // namespace boxstream::bench
