// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <exception>
#include <optional>

#include <boxstream/executor.hpp>

#include "simulation/effects/scene_instance.hpp"
#include "simulation/run/energy_account.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes {

struct Simulation::Impl {
  Impl(Simulation& self, const Scene& description, const std::string& broadphase, const Wrap& wrap, effects::Plan plan,
       Expanded expanded);

  /// What a new Simulation does once all is built.
  void warm_up();
  /// A step, with its substeps and hooks.
  void advance();
  /// Runs inside the step; keeps exceptions from passing through Bullet.
  void on_pairs() noexcept;
  /// Whether pairs are looked at there, and not after the step.
  bool pairs_within_step() const;
  /// Notes what the step has to show of pairs, exact ones and ghosts.
  void take_pairs();

  /// Begins or goes on with the account of energy, or leaves it for the steps that follow.
  void account_for(bool on);

  void begin_checks();
  /// Asks the checks whose time it is.
  void observe();

  Simulation& self;
  Scene scene;
  std::string broadphase_name;
  effects::Plan plan;
  WorldRecipe recipe;
  std::unique_ptr<Executor> executor;  // outlives the broad-phase
  BulletWorld world;
  effects::SceneInstance instance;

  std::vector<Pair> pairs;
  bool plain = false;  // the step that is running is one of `Simulation::advance`
  std::uint64_t ghost_overlaps = 0;
  std::uint64_t exact_pairs = 0;
  bool want_exact = false;
  std::vector<Pair> former_pairs;
  std::function<void()> after_pairs;
  std::exception_ptr thrown;
  std::chrono::nanoseconds observing{};  // spent in on_pairs during the current step

  std::optional<EnergyAccount> energy;
  bool accounting = false;  // in the step that is running

  bool may_leave = false;     // bodies may be taken out of the world after a step
  bool monitored = false;     // by checks of the scene
  bool count_missed = false;  // of pairs, in each step: one of them needs it
  std::uint64_t missed_pairs = 0;
  double first_energy = 0, energy_scale = 0;
  double residual = 0;  // of the last step
  std::vector<CheckResult> check_results;

  mutable std::vector<btScalar> state;
  mutable std::vector<std::array<float, 3>> soft_vertices;
  mutable std::vector<std::array<std::uint32_t, 3>> soft_triangles;
};

}  // namespace boxstream::scenes
