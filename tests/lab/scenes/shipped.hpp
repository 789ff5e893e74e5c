// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <ostream>
#include <string>
#include <vector>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/names.hpp"
#include "formats/scene_model/scene.hpp"
#include "sanitized.hpp"

namespace boxstream::scenes_test {

/// Sanitizers make everything several times slower; the same checks then run over fewer steps.
inline constexpr int slowness = tests::sanitized ? 6 : 1;

/// Those that a world can have; under sanitizers, which do not see into Bullet's, boxstream alone.
inline std::vector<std::string> broadphases() {
  return tests::sanitized ? std::vector<std::string>{"boxstream"} : scenes::broadphase_names();
}

/// The scenes in demos/scenes, and how much of each is enough for a test that runs it on every broad-phase.
struct Shipped {
  std::string name;
  double factor;
  int steps;
};

inline const std::vector<Shipped> shipped_scenes{
    {"arm", 1, 120},
    {"bin_picking", 0.2, 60},
    {"box3d_joint_grid", 0.02, 60},
    {"box3d_large_pyramid", 0.02, 20},
    {"box3d_large_world", 0.2, 80},
    {"box3d_many_pyramids", 0.02, 30},
    {"box3d_rain", 0.1, 150},
    {"box3d_washer", 0.03, 80},
    {"broadmark_brownian_assorted", 0.15, 24},
    {"broadmark_brownian_cubes", 0.15, 24},
    {"broadmark_brownian_spheres", 0.15, 24},
    {"broadmark_fall_assorted", 0.15, 24},
    {"broadmark_fall_cubes", 0.15, 24},
    {"broadmark_fall_spheres", 0.15, 24},
    {"broadmark_gravity_assorted", 0.15, 24},
    {"broadmark_gravity_cubes", 0.15, 24},
    {"broadmark_gravity_spheres", 0.15, 24},
    {"bullet1", 0.3, 200},
    {"bullet2", 0.2, 60},
    {"bullet3", 0.1, 80},
    {"bullet4", 0.2, 80},
    {"bullet5", 0.2, 100},
    {"bullet6", 0.2, 100},
    {"bullet7", 0.2, 100},
    {"bullet8", 0.15, 100},
    {"character", 0.6, 300},
    {"cloth", 0.3, 120},
    {"hopper", 0.03, 100},
    {"jolt_convex_vs_mesh", 0.05, 160},
    {"jolt_high_speed", 0.03, 40},
    {"jolt_pyramid", 0.05, 40},
    {"jolt_ragdoll_piles", 0.05, 60},
    {"pile", 0.06, 160},
    {"ragdolls", 0.15, 120},
    {"storm", 0.03, 120},
    {"terrain", 0.1, 240},
    {"wall", 0.25, 150},
};

/// Scenes of stacks are there to stand: their pairs begin and do not end.
inline bool stands_still(const scenes::Scene& scene) {
  return std::find(scene.meta.tags.begin(), scene.meta.tags.end(), "stacks") != scene.meta.tags.end();
}

/// For the listings of ctest.
inline void PrintTo(const Shipped& shipped, std::ostream* out) {
  *out << shipped.name;
}

inline int steps_of(const Shipped& shipped) {
  return std::max(20, shipped.steps / slowness);
}

inline std::string file_of(const std::string& name) {
  return scenes::shipped(name + ".json");
}

inline scenes::Scene reduced(const Shipped& shipped) {
  return scenes::scaled(scenes::load_scene(file_of(shipped.name)), shipped.factor);
}

}  // namespace boxstream::scenes_test
