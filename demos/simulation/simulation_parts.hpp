// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <exception>

#include "simulation/bullet_world.hpp"
#include "simulation/convert.hpp"
#include "simulation/simulation.hpp"
#include "simulation/world_objects.hpp"

namespace boxstream::scenes {

struct Simulation::Impl {
  Impl(Simulation& self, const Scene& description, const std::string& broadphase, const Wrap& wrap, Expanded expanded);

  /// Runs inside the step; keeps exceptions from passing through Bullet.
  void on_pairs() noexcept;
  /// Notes what the step has to show of pairs, exact ones and ghosts.
  void take_pairs();
  void before_step();
  void after_step();

  Simulation& self;
  Scene scene;
  std::string broadphase_name;
  BulletWorld world;
  WorldObjects things;

  std::uint64_t steps = 0;
  std::vector<Pair> pairs;
  std::uint64_t ghost_overlaps = 0;
  std::uint64_t exact_pairs = 0;
  bool want_exact = false;
  std::vector<Pair> former_pairs;
  std::function<void()> observer;
  std::exception_ptr thrown;
  std::chrono::nanoseconds observing{};  // spent in on_pairs during the current step
  mutable std::vector<float> state;
  mutable std::vector<std::array<float, 3>> soft_vertices;
  mutable std::vector<std::array<std::uint32_t, 3>> soft_triangles;
};

}  // namespace boxstream::scenes
