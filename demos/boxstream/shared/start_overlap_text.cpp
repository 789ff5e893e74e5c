// SPDX-License-Identifier: MIT
#include "boxstream/shared/start_overlap_text.hpp"

#include <fmt/format.h>

#include "base/printable.hpp"
#include "formats/scene_model/expand.hpp"

namespace boxstream::tool {

std::string start_overlap_text(const scenes::Scene& scene, const scenes::StartOverlaps& overlaps) {
  if (overlaps.deepest.empty()) return {};
  const scenes::Expanded expanded = scenes::expand(scene);
  const auto told = [&](std::uint32_t body) {
    const std::string& name = expanded.bodies[body].name;
    return name.empty() ? fmt::format("{}", body) : fmt::format("{} ({})", body, files::printable(name));
  };
  const scenes::StartOverlap& deepest = overlaps.deepest.front();
  const std::size_t pairs = overlaps.deepest.size();
  return fmt::format("{}{} of bodies deep in each other at the start; the deepest, {} and {}, by {:.3g} m{}",
                     overlaps.all ? "" : "at least ", pairs == 1 ? "one pair" : fmt::format("{} pairs", pairs),
                     told(deepest.a), told(deepest.b), deepest.depth,
                     scene.solver.split_impulse ? ": they are moved apart without speed"
                                                : ": they are thrown apart, since split_impulse is false");
}

}  // namespace boxstream::tool
