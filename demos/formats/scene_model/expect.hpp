// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

namespace boxstream::scenes {

/// What a scene says about itself; every number is checked against what was built.
struct Expect {
  std::optional<std::uint64_t> objects;  // everything the broad-phase sees
  std::optional<std::uint64_t> bodies;   // rigid, fixed ones included
  std::optional<std::uint64_t> fixed;
  std::optional<std::uint64_t> kinematic;
  std::optional<std::uint64_t> dynamic;
  std::optional<std::uint64_t> joints;
  std::optional<std::uint64_t> sensors;
  std::optional<std::uint64_t> characters;
  std::optional<std::uint64_t> soft_bodies;
  std::optional<std::uint64_t> soft_nodes;
  std::optional<std::uint64_t> boxes;
  std::optional<std::uint64_t> spheres;
  std::optional<std::uint64_t> capsules;
  std::optional<std::uint64_t> cylinders;
  std::optional<std::uint64_t> cones;
  std::optional<std::uint64_t> hulls;
  std::optional<std::uint64_t> planes;
  std::optional<std::uint64_t> heightfields;
  std::optional<std::uint64_t> meshes;
  std::optional<std::uint64_t> compounds;
  std::optional<double> size_ratio;  // largest over smallest box diagonal of the dynamic bodies, at least
};

}  // namespace boxstream::scenes
