// SPDX-License-Identifier: MIT
#include <algorithm>
#include <filesystem>
#include <random>
#include <vector>

#include "formats/scene_json/load_scene.hpp"
#include "load.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::soak {
namespace {

/// All that can be simulated, large and small.
std::vector<std::string> scene_files() {
  std::vector<std::string> files;
  for (const char* folder : {"", "effects", "hard"})
    for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped(folder)))
      if (entry.path().extension() == ".json" && !entry.path().stem().string().starts_with("query_"))
        files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

class BulletLoad final : public Load {
 public:
  std::uint64_t round(std::uint64_t seed) override {
    std::mt19937_64 random(seed);
    const std::string& file = files_[random() % files_.size()];
    scenes::Scene scene = scenes::load_scene(file);
    const std::uint64_t objects = scenes::Simulation(scene, "boxstream").census().objects;
    if (objects > most_objects) scene = scenes::scaled(scene, double(most_objects) / double(objects));
    scenes::Simulation simulation(scene, "boxstream");
    std::uint64_t compared = 0;
    int step = 0;
    simulation.set_after_pairs([&] {
      if (++step % 5 != 0) return;
      for (const std::string& difference : {scenes::check_pairs(simulation), scenes::check_ghosts(simulation)})
        if (!difference.empty()) throw Wrong(file + ", step " + std::to_string(step) + ": " + difference);
      compared += 2;
    });
    for (const auto steps = 10 + random() % 40; simulation.steps_done() < steps;) simulation.advance();
    return compared;
  }

 private:
  static constexpr std::uint64_t most_objects = 800;
  std::vector<std::string> files_ = scene_files();
};

}  // namespace

std::unique_ptr<Load> bullet_load() {
  return std::make_unique<BulletLoad>();
}

}  // namespace boxstream::soak
