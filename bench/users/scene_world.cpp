// SPDX-License-Identifier: MIT
#include "users/scene_world.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::bench {

namespace {

class SceneWorld final : public SteppedWorld {
 public:
  SceneWorld(const scenes::Scene& scene, const std::string& broadphase, Part last)
      : simulation_(scene, broadphase), last_(last) {
    simulation_.set_after_pairs([this] {
      if (check_this_step_ && difference_.empty()) difference_ = scenes::check_pairs(simulation_);
    });
  }

  void step(bool check) override {
    check_this_step_ = check;
    scenes::StepOptions nothing_extra;
    nothing_extra.events = nothing_extra.exact_pairs = nothing_extra.hash = false;
    const scenes::StepResult result = simulation_.step(nothing_extra);
    pairs_ = result.pairs;
    times_[Part::update] = result.update_aabbs_ms;
    times_[Part::pairs] = result.overlapping_pairs_ms;
    times_[Part::dispatch] = result.dispatch_ms;
    times_[Part::solve] = result.solve_ms;
    times_[Part::sum] = result.broadphase_ms + (last_ == Part::dispatch ? result.dispatch_ms : 0);
    times_[Part::whole] = result.step_ms;
    times_[Part::rest] = result.step_ms - result.broadphase_ms - result.dispatch_ms - result.solve_ms;
    times_[Part::rays] = result.queries_ms;
  }

  std::size_t objects() const override { return simulation_.objects().size(); }
  bool casts_rays() const override { return !simulation_.scene().queries.empty(); }
  std::string broadphase() const override { return simulation_.broadphase_name(); }

 private:
  scenes::Simulation simulation_;
  Part last_;
  bool check_this_step_ = false;
};

}  // namespace

std::string scene_path(const std::string& name) {
  return scenes::shipped(fmt::format("{}.json", name));
}

void run_scene(const Summed& summed, SceneCase scene, const Options& options, const std::vector<std::string>& peers,
               Report& report, Progress& progress) {
  const int steps = options.steps > 0 ? options.steps : options.quick ? scene.quick_steps : scene.windows.back().end;
  std::erase_if(scene.windows, [&](const Window& window) { return window.begin >= steps; });
  if (scene.windows.empty()) scene.windows = {{"", 0, steps}};
  scene.windows.back().end = std::min(scene.windows.back().end, steps);
  const scenes::Scene loaded = scenes::load_scene(scene_path(scene.scene));
  std::vector<std::unique_ptr<SteppedWorld>> worlds;
  worlds.push_back(std::make_unique<SceneWorld>(loaded, "boxstream", summed.last));
  for (const std::string& peer : peers) worlds.push_back(std::make_unique<SceneWorld>(loaded, peer, summed.last));
  contest_steps({summed.suite, scene.scene, scene.windows}, std::move(worlds), report, progress);
}

}  // namespace boxstream::bench
