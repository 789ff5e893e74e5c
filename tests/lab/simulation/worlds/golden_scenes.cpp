// SPDX-License-Identifier: MIT
#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <algorithm>
#include <filesystem>

#include "formats/scene_json/load_scene.hpp"
#include "golden.hpp"
#include "scenes/shipped.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::worlds_test {
namespace {

using namespace boxstream;

constexpr int most_steps = 60;

}  // namespace

std::vector<std::string> golden_names() {
  std::vector<std::string> names;
  for (const scenes_test::Shipped& shipped : scenes_test::shipped_scenes) names.push_back(shipped.name);
  for (const std::string folder : {"hard", "effects"})
    for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped(folder)))
      if (entry.path().extension() == ".json") names.push_back(folder + "/" + entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string golden_line(const std::string& name) {
  const auto shipped = std::find_if(scenes_test::shipped_scenes.begin(), scenes_test::shipped_scenes.end(),
                                    [&](const scenes_test::Shipped& s) { return s.name == name; });
  scenes::Scene scene = shipped != scenes_test::shipped_scenes.end() ? scenes_test::reduced(*shipped)
                                                                     : scenes::load_scene(scenes_test::file_of(name));
  scene.checks.clear();
  const int steps = std::min({scene.time.steps, most_steps});
  scenes::Simulation simulation(scene, "boxstream");
  Fold pairs, states;
  for (int i = 0; i < steps; ++i) {
    simulation.advance();
    const btOverlappingPairCache& cache = *simulation.broadphase().getOverlappingPairCache();
    for (int k = 0; k < cache.getNumOverlappingPairs(); ++k) {
      const btBroadphasePair& pair = cache.getOverlappingPairArrayPtr()[k];
      pairs.add(static_cast<std::uint64_t>(pair.m_pProxy0->m_uniqueId) << 32 |
                static_cast<std::uint64_t>(pair.m_pProxy1->m_uniqueId));
    }
    pairs.add(0);
    states.add(simulation.state_hash());
  }
  return golden_line(name, "float", steps, pairs, states);
}

}  // namespace boxstream::worlds_test
