// SPDX-License-Identifier: MIT
#include <cmath>
#include <stdexcept>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

Scene scaled(const Scene& scene, double factor) {
  if (!(factor > 0) || !std::isfinite(factor)) throw std::invalid_argument("a scale factor must be positive");
  Scene result = scene;
  const Scaling scaling{factor, scene.world.self_similar};
  std::size_t bodies = 0;
  const auto scale = [&](auto& part) { part.scale(scaling); };
  for (Generator& generator : result.generators) {
    std::visit(scale, generator);
    if ((bodies += most_bodies(generator)) > most_scaled_bodies) Scaling::fail();
  }
  for (Field& field : result.fields) std::visit(scale, field);
  for (Query& query : result.queries)
    if (auto* fan = std::get_if<RayFan>(&query)) fan->count = Scaling::times(fan->count, factor);
  for (SoftBody& soft : result.soft_bodies) {
    if (auto* cloth = std::get_if<ClothSoft>(&soft.value)) {
      for (int& n : cloth->resolution) n = Scaling::times(n, scaling.face, 2);
    } else {
      int& resolution = std::get<BallSoft>(soft.value).resolution;
      resolution = Scaling::times(resolution, factor, 8);
    }
  }
  WorldSettings& world = result.world;
  if (factor > 1 || world.self_similar) {
    // Rooms grow about their floor; the bounds must still hold them.
    scaling.room(world.bounds.min);
    scaling.room(world.bounds.max);
  }
  if (world.self_similar) {
    scaling.room(world.gravity);
    if (world.tumbling) world.tumbling->strength *= scaling.side;
  }
  result.expect = {};
  return result;
}

}  // namespace boxstream::scenes
