// SPDX-License-Identifier: MIT
#include "boxstream/advice/warnings.hpp"

#include <string>

#include <fmt/format.h>

#include "base/words.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/scene.hpp"
#include "simulation/effects/unfit.hpp"
#include "simulation/run/start_overlaps.hpp"

namespace boxstream::tool {
namespace {

/// One line about bodies that start in each other, the deepest of them by number and name; empty if there are none.
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

}  // namespace

Warnings warnings_of(const scenes::Scene& scene) {
  Warnings found;
  found.overlaps = scenes::overlaps_at_start(scene);
  found.overlap = start_overlap_text(scene, found.overlaps);
  found.wrong = effects::unfit(scene);
  found.hard = hard_cases(scene);
  found.coarse = coarse_steps(scene);
  return found;
}

std::vector<std::string> Warnings::lines() const {
  std::vector<std::string> all;
  if (!overlap.empty()) all.push_back("overlap: " + overlap);
  for (const std::string& each : wrong) all.push_back("wrong: " + each);
  for (const HardCase& each : hard) all.push_back(fmt::format("hard: {}; {}", each.what, each.advice));
  for (const CoarseStep& each : coarse) all.push_back(fmt::format("coarse: {}; {}", each.what, each.advice));
  return all;
}

}  // namespace boxstream::tool
