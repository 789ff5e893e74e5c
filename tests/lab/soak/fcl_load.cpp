// SPDX-License-Identifier: MIT
#include <random>

#include "formats/scene_json/load_scene.hpp"
#include "load.hpp"
#include "simulation/query/run.hpp"

namespace boxstream::soak {
namespace {

class FclLoad final : public Load {
 public:
  std::uint64_t round(std::uint64_t seed) override {
    std::mt19937_64 random(seed);
    const char* const names[] = {"arm", "bins", "convoy"};
    const std::string name = names[random() % std::size(names)];
    query::QueryScene scene = query::load_query_scene(scenes::shipped("query_" + name + ".json"));
    scene.seed = seed;
    scene = query::scaled(scene, std::uniform_real_distribution<double>(0.05, 0.3)(random));
    const query::RunResult result = query::run(scene, "boxstream", "tree", 5, [](auto, auto, auto) {});
    if (!result.answers_equal.value_or(false))
      throw Wrong("query_" + name + ", seed " + std::to_string(seed) + ": " + result.first_difference);
    return 5 * scene.queries.size();
  }
};

}  // namespace

std::unique_ptr<Load> fcl_load() {
  return std::make_unique<FclLoad>();
}

}  // namespace boxstream::soak
