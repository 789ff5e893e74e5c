// SPDX-License-Identifier: MIT
#include "simulation/effects/unfit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "simulation/effects/find.hpp"
#include "simulation/effects/shape_size.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

/// The body of which `worth(body)` is largest, if that is above 1.
template <class Worth>
std::optional<std::size_t> worst(const Subject& subject, Worth worth) {
  std::optional<std::size_t> found;
  double most = 1;
  for (std::size_t i = 0; i < subject.expanded.bodies.size(); ++i)
    if (const double w = worth(subject.expanded.bodies[i]); w > most) most = w, found = i;
  return found;
}

std::string name_of(const Subject& subject, std::size_t body) {
  const std::string& name = subject.expanded.bodies[body].name;
  return name.empty() ? fmt::format("body {}", body) : fmt::format("body {} (\"{}\")", body, name);
}

}  // namespace

std::vector<std::string> unfit(const Subject& subject) {
  std::vector<std::string> lines = not_by_multibodies(subject);
  if (!has_contacts(subject)) return lines;
  const Scene& scene = subject.scene;
  const double substep = scene.time.dt / scene.time.substeps,
               fall = strength_of_gravity(scene.world) * substep * substep;
  const auto size = [&](const Body& body) {
    return is_dynamic(body) ? size_of(subject.expanded.shapes, body.traits.shape).largest : 0;
  };
  const auto falls_far = [&](const Body& body) { return size(body) > 0 ? 2 * fall / size(body) : 0; };
  if (const auto i = worst(subject, falls_far)) {
    const double extent = size(subject.expanded.bodies[*i]);
    lines.push_back(
        fmt::format("{} is {:.2g} m large and falls {:.2g} m in a step from rest: what it hits, it is deep in or "
                    "beyond; take {:.0f} substeps or more",
                    name_of(subject, *i), extent, fall,
                    std::ceil(scene.time.dt / std::sqrt(extent / 8 / strength_of_gravity(scene.world)))));
  }
  return lines;
}

std::vector<std::string> unfit(const Scene& scene) {
  const Expanded expanded = expand(scene);
  return unfit(Subject{scene, expanded});
}

}  // namespace boxstream::effects
