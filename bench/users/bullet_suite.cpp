// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

#include "formats/scene_json/load_scene.hpp"
#include "suites/suites.hpp"
#include "users/scene_world.hpp"

namespace boxstream::bench {

namespace {

/// The pile falls for the first 250 steps and lies still in the last ones.
const SceneCase scene_cases[] = {
    {"pile", {{"", warm_up_steps, 250}, {":rest", 480, 600}}, 40},
    {"storm", {{"", warm_up_steps, 120}}, 25},
    {"terrain", {{"", warm_up_steps, 300}}, 80},
    {"wall", {{"", warm_up_steps, 300}}, 60},
    {"ragdolls", {{"", warm_up_steps, 300}}, 60},
    {"character", {{"", warm_up_steps, 300}}, 100},
    {"bullet5", {{"", warm_up_steps, 300}}, 40},
    {"bullet6", {{"", warm_up_steps, 300}}, 40},
};

/// Scenes that are not on the list run as long as they say.
SceneCase case_of(const std::string& name) {
  for (const SceneCase& known : scene_cases)
    if (known.scene == name) return known;
  return {name, {{"", warm_up_steps, scenes::load_scene(scene_path(name)).time.steps}}, 60};
}

}  // namespace

bool is_scene(const std::string& name) {
  return std::filesystem::exists(scene_path(name));
}

void run_bullet_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> peers = options.peers;
  if (peers.empty()) peers = {"hybrid", "dbvt", "dbvt-deferred", "sap"};
  std::vector<std::string> cases = options.cases;
  if (cases.empty())
    std::transform(std::begin(scene_cases), std::end(scene_cases), std::back_inserter(cases),
                   [](const SceneCase& scene) { return scene.scene; });
  for (const std::string& name : cases)
    run_scene({"bullet", Part::dispatch}, case_of(name), options, peers, report, progress);
}

}  // namespace boxstream::bench
