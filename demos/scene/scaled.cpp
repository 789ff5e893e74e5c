// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scene/scene.hpp"

namespace boxstream::scenes {
namespace {

int times(int count, double factor, int least) {
  return std::max(least, static_cast<int>(std::lround(count * factor)));
}

struct Scaling {
  double factor;
  double side = std::cbrt(factor);
  double face = std::sqrt(factor);

  /// Keeps the shape of a lattice, and never makes it so narrow that it grows taller than it was.
  void columns(std::array<int, 2>& c) const {
    for (int& n : c) n = std::max(1, static_cast<int>(std::ceil(n * side)));
  }
  void operator()(GridGenerator& g) const {
    g.count = times(g.count, factor, 1);
    columns(g.columns);
  }
  void operator()(WallGenerator& g) const {
    g.columns = times(g.columns, face, 1);
    g.rows = times(g.rows, face, 1);
  }
  void operator()(ChainGenerator&) const {}
  void operator()(ImportGenerator&) const {}
  void operator()(RagdollGenerator& g) const {
    g.count = times(g.count, factor, 1);
    columns(g.columns);
  }
  void operator()(ContainerGenerator& g) const {
    for (double& x : g.size) x *= side;
  }
  void operator()(PyramidGenerator& g) const { g.levels = times(g.levels, g.flat ? face : side, 1); }
  void operator()(TowerGenerator& g) const { g.levels = times(g.levels, factor, 1); }
  void operator()(RainGenerator& g) const {
    g.count = times(g.count, factor, 1);
    g.at_once = times(g.at_once, factor, 1);
    for (double& x : g.size) x *= side;
  }
  void operator()(ScatterGenerator& g) const {
    g.count = times(g.count, factor, 1);
    for (double& x : g.size) x *= side;
  }
};

}  // namespace

Scene scaled(const Scene& scene, double factor) {
  if (!(factor > 0) || !std::isfinite(factor)) throw std::invalid_argument("a scale factor must be positive");
  Scene result = scene;
  const Scaling scaling{factor};
  for (Generator& generator : result.generators) std::visit(scaling, generator);
  for (Field& field : result.fields)
    if (auto* swirl = std::get_if<SwirlField>(&field)) {
      swirl->radius *= scaling.side;
      swirl->height *= scaling.side;
    }
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
  if (factor > 1) {
    // Rooms grow about their floor; the bounds must still hold them.
    for (std::size_t d = 0; d < 3; ++d) {
      result.world.bounds.min[d] *= scaling.side;
      result.world.bounds.max[d] *= scaling.side;
    }
  }
  result.expect = {};
  return result;
}

}  // namespace boxstream::scenes
