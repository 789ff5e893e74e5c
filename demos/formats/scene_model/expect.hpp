// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "formats/scene_model/shapes.hpp"

namespace boxstream::scenes {

/// A number for each kind of thing in a scene.
template <class Count>
struct Counts {
  Count objects{};  // everything the broad-phase sees
  Count bodies{};   // rigid, fixed ones included
  Count fixed{}, kinematic{}, dynamic{};
  Count joints{}, sensors{}, characters{}, soft_bodies{}, soft_nodes{};
  std::array<Count, std::variant_size_v<ShapeValue>> shapes{};  // bodies by kind of shape
};

/// What a scene says about itself; every number is checked against what was built.
struct Expect : Counts<std::optional<std::uint64_t>> {
  std::optional<double> size_ratio;  // largest over smallest box diagonal of the dynamic bodies, at least
};

/// How many of what was built.
struct Census : Counts<std::uint64_t> {
  double size_ratio = 0;  // largest over smallest box diagonal of the dynamic bodies
};

/// Calls visit(name, a's count, b's count) for each kind; names are those of a scene's "expect".
template <class A, class B, class Visit>
void for_each_count(A& a, B& b, const Visit& visit) {
  visit("objects", a.objects, b.objects);
  visit("bodies", a.bodies, b.bodies);
  visit("static", a.fixed, b.fixed);
  visit("kinematic", a.kinematic, b.kinematic);
  visit("dynamic", a.dynamic, b.dynamic);
  visit("joints", a.joints, b.joints);
  visit("sensors", a.sensors, b.sensors);
  visit("characters", a.characters, b.characters);
  visit("soft_bodies", a.soft_bodies, b.soft_bodies);
  visit("soft_nodes", a.soft_nodes, b.soft_nodes);
  const auto names = []<class... S>(const std::variant<S...>*) { return std::array{S::plural...}; };
  const auto plurals = names(static_cast<const ShapeValue*>(nullptr));
  for (std::size_t i = 0; i < plurals.size(); ++i) visit(plurals[i], a.shapes[i], b.shapes[i]);
}

}  // namespace boxstream::scenes
