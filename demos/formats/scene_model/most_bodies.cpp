// SPDX-License-Identifier: MIT
#include "formats/scene_model/generators.hpp"

namespace boxstream::scenes {
namespace {

std::size_t area(const std::array<int, 2>& columns) {
  return static_cast<std::size_t>(columns[0]) * static_cast<std::size_t>(columns[1]);
}

struct CountBodies {
  std::size_t operator()(const GridGenerator& g) const { return static_cast<std::size_t>(g.count); }
  std::size_t operator()(const WallGenerator& g) const {
    return static_cast<std::size_t>(g.columns + 1) * static_cast<std::size_t>(g.rows);
  }
  std::size_t operator()(const ChainGenerator& g) const { return static_cast<std::size_t>(g.links) + 1; }
  std::size_t operator()(const RagdollGenerator& g) const { return static_cast<std::size_t>(g.count) * 11; }
  std::size_t operator()(const ContainerGenerator&) const { return 6; }
  std::size_t operator()(const PyramidGenerator& g) const {
    const auto n = static_cast<std::size_t>(g.levels);
    return (g.flat ? n * (n + 1) / 2 : n * (n + 1) * (2 * n + 1) / 6) * area(g.repeat);
  }
  std::size_t operator()(const TowerGenerator& g) const {
    return static_cast<std::size_t>(g.levels) * static_cast<std::size_t>(g.around);
  }
  std::size_t operator()(const ScatterGenerator& g) const { return static_cast<std::size_t>(g.count); }
  std::size_t operator()(const RespawnGenerator& g) const { return static_cast<std::size_t>(g.count); }
  std::size_t operator()(const BallRandomGenerator& g) const { return static_cast<std::size_t>(g.start.count); }
  std::size_t operator()(const Assorted80Generator& g) const { return static_cast<std::size_t>(g.start.count); }
  std::size_t operator()(const JointGridGenerator& g) const { return area(g.columns); }
  std::size_t operator()(const DrumGenerator&) const { return 3; }
  std::size_t operator()(const ImportGenerator& g) const { return g.bodies.size(); }
};

}  // namespace

std::size_t most_bodies(const Generator& generator) {
  return std::visit(CountBodies{}, generator);
}

}  // namespace boxstream::scenes
