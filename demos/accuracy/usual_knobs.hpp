// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "formats/scene_model/expand.hpp"
#include "knob.hpp"

namespace boxstream::accuracy {

inline std::size_t count_dynamic(const scenes::Expanded& expanded) {
  return static_cast<std::size_t>(
      std::count_if(expanded.bodies.begin(), expanded.bodies.end(),
                    [](const scenes::Body& body) { return body.traits.type == scenes::BodyType::dynamic; }));
}

inline bool has_bounces(const scenes::Expanded& expanded) {
  return std::any_of(expanded.bodies.begin(), expanded.bodies.end(), [](const scenes::Body& body) {
    return body.traits.material.restitution > 0 && body.traits.type == scenes::BodyType::dynamic;
  });
}

/// Solvers of the whole matrix take a time that is cubic in the rows of an island, and give up beyond 300.
inline bool suits_matrix(const scenes::Scene& scene, const scenes::Expanded& expanded) {
  return scene.soft_bodies.empty() && count_dynamic(expanded) <= 40;
}

/// Knobs that are worth trying on a scene: finer steps, more iterations, and the solvers that suit it. What the scene
/// has by itself is among their values.
std::vector<Knob> usual_knobs(const scenes::Scene& scene, bool has_doubles = false);

}  // namespace boxstream::accuracy
