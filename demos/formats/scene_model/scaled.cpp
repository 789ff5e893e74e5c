// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {
namespace {

[[noreturn]] void too_many() {
  throw std::invalid_argument("that makes more than " + std::to_string(most_scaled_bodies) + " bodies");
}

int times(int count, double factor, int least) {
  const double scaled = std::round(count * factor);
  if (scaled > static_cast<double>(most_scaled_bodies)) too_many();
  return std::max(least, static_cast<int>(scaled));
}

bool is_ground(const GridGenerator& g) {
  const auto moves = [](const MixEntry& entry) { return entry.traits.type == BodyType::dynamic; };
  return g.count <= g.columns[0] * g.columns[1] && std::none_of(g.mix.begin(), g.mix.end(), moves);
}

struct Scaling {
  double factor;
  bool self_similar;
  double side = std::cbrt(factor);
  double face = std::sqrt(factor);

  /// Keeps the shape of a lattice, and never makes it so narrow that it grows taller than it was.
  void columns(std::array<int, 2>& c, double by) const {
    constexpr auto most = static_cast<double>(most_scaled_bodies);
    for (int& n : c) n = static_cast<int>(std::clamp(std::ceil(n * by), 1.0, most));
  }
  void room(Vec3& v) const {
    for (double& x : v) x *= side;
  }
  void start(BallStart& s) const {
    s.count = times(s.count, factor, 1);
    s.radius *= side;
    if (!self_similar) return;
    room(s.centre);
    s.speed *= side;
  }
  void operator()(GridGenerator& g) const {
    if (!g.scales) return;
    columns(g.columns, is_ground(g) ? face : side);
    g.count = times(g.count, factor, 1);
  }
  void operator()(WallGenerator& g) const {
    g.columns = times(g.columns, face, 1);
    g.rows = times(g.rows, face, 1);
  }
  void operator()(ChainGenerator&) const {}
  void operator()(ImportGenerator&) const {}
  void operator()(RagdollGenerator& g) const {
    g.count = times(g.count, factor, 1);
    columns(g.columns, side);
  }
  void operator()(ContainerGenerator& g) const {
    room(g.size);
    if (!self_similar) return;
    room(g.floor);
    g.thickness *= side;
  }
  void operator()(PyramidGenerator& g) const {
    if (g.repeat != std::array<int, 2>{1, 1}) {
      for (int& n : g.repeat) n = times(n, face, 1);
    } else {
      g.levels = times(g.levels, g.flat ? face : side, 1);
    }
  }
  void operator()(TowerGenerator& g) const { g.levels = times(g.levels, factor, 1); }
  void operator()(RespawnGenerator& g) const {
    g.count = times(g.count, factor, 1);
    g.at_once = times(g.at_once, factor, 1);
    for (double& x : g.size) x *= side;
  }
  void operator()(ScatterGenerator& g) const {
    g.count = times(g.count, factor, 1);
    room(g.size);
  }
  void operator()(BallRandomGenerator& g) const { start(g.start); }
  void operator()(Assorted80Generator& g) const { start(g.start); }
  void operator()(JointGridGenerator& g) const {
    for (int& n : g.columns) n = times(n, face, 1);
    g.held = std::min(g.held, g.columns[0]);
  }
  void operator()(DrumGenerator& g) const {
    g.radius *= side;
    g.length *= side;
    g.depth *= side;
  }

  void operator()(VortexField& vortex) const {
    vortex.radius *= side;
    vortex.height *= side;
  }
  void operator()(ImpulsesField& impulses) const {
    if (self_similar) impulses.speed *= side;
  }
  void operator()(WindField&) const {}
  void operator()(DragField&) const {}
  void operator()(BuoyancyField&) const {}
};

}  // namespace

Scene scaled(const Scene& scene, double factor) {
  if (!(factor > 0) || !std::isfinite(factor)) throw std::invalid_argument("a scale factor must be positive");
  Scene result = scene;
  const Scaling scaling{factor, scene.world.self_similar};
  std::size_t bodies = 0;
  for (Generator& generator : result.generators) {
    std::visit(scaling, generator);
    if ((bodies += most_bodies(generator)) > most_scaled_bodies) too_many();
  }
  for (Field& field : result.fields) std::visit(scaling, field);
  for (Query& query : result.queries)
    if (auto* fan = std::get_if<RayFan>(&query)) fan->count = times(fan->count, factor, 1);
  for (SoftBody& soft : result.soft_bodies) {
    if (auto* cloth = std::get_if<ClothSoft>(&soft.value)) {
      for (int& n : cloth->resolution) n = times(n, scaling.face, 2);
    } else {
      int& resolution = std::get<BallSoft>(soft.value).resolution;
      resolution = times(resolution, factor, 8);
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
