// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdlib>

#include <LinearMath/btAlignedAllocator.h>

#include "formats/scene_json/load_scene.hpp"
#include "gallery.hpp"
#include "heap_watch.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using scenes::Simulation;

std::uint64_t bullet_allocations = 0;

/// Counts what Bullet takes for itself, by functions of its own and not by operator new.
class BulletWatch {
 public:
  BulletWatch() {
    btAlignedAllocSetCustomAligned(
        [](std::size_t size, int alignment) {
          ++bullet_allocations;
          const auto step = static_cast<std::size_t>(alignment);
          return std::aligned_alloc(step, (size + step - 1) / step * step);
        },
        [](void* block) { std::free(block); });
  }
};

/// The functions stay for good: blocks taken before would go back to the wrong one.
void watch_bullet() {
  static const BulletWatch watch;
}

struct Taken {
  std::uint64_t ours, bullets;
};

/// In `steps` steps after `warm_up` others.
Taken taken(const scenes::Scene& scene, int warm_up, int steps) {
  watch_bullet();
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < warm_up; ++i) simulation.advance();
  const std::uint64_t ours = tests::heap_watch::allocations(), bullets = bullet_allocations;
  for (int i = 0; i < steps; ++i) simulation.advance();
  return {tests::heap_watch::allocations() - ours, bullet_allocations - bullets};
}

/// Bodies that come and go make lists grow; of cloth below.
const Names never_at_rest{"respawn", "soft_bodies"};

TEST(Allocations, AreNoneInTheStepsOfScenesThatHaveSettled) {
  for (const Exhibit& e : gallery()) {
    if (never_at_rest.count(e.name) > 0) continue;
    const Taken found = taken(exhibit(e.name), 400, 60);
    EXPECT_EQ(found.ours, 0u) << e.name;
    // Dantzig's solver of Bullet takes the matrix anew in each step.
    EXPECT_EQ(found.bullets, e.name == Names::value_type("other_solver") ? 60u : 0u) << e.name;
  }
}

TEST(Allocations, AreNoneOfOursOnceAPileHasSettled) {
  const scenes::Scene scene = scenes::scaled(scenes::load_scene(scenes::shipped("pile.json")), 0.02);
  const Taken found = taken(scene, 300, 60);
  EXPECT_EQ(found.ours, 0u);
  // Bullet's: lists of contacts and islands that have not been as long before.
  EXPECT_LT(found.bullets, 60u);
}

TEST(Allocations, OfAClothAreBulletsAlone) {
  const Taken found = taken(exhibit("soft_bodies"), 400, 60);
  EXPECT_EQ(found.ours, 0u);
  EXPECT_EQ(found.bullets, 4u * 60) << "four for each step of a soft body";
}

}  // namespace
}  // namespace boxstream::effects_test
