// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/scene_model/settings.hpp"
#include "front.hpp"
#include "knob.hpp"
#include "measure.hpp"
#include "measure/statistics.hpp"
#include "settle.hpp"
#include "trajectory.hpp"

namespace boxstream::scenes {
struct Scene;
}

namespace boxstream::accuracy {

inline constexpr int reference_substeps = 64;

/// What a body's velocity is at the end, by a closed form.
struct Expected {
  std::size_t body = 0;  ///< its place among all objects
  std::array<double, 3> velocity{};
};

struct Request {
  std::string file;                ///< of the scene, for messages and for files that it names
  nlohmann::json scene;            ///< its text; checks and outputs in it are left out
  std::vector<Knob> knobs;         ///< at least one
  double most_product = HUGE_VAL;  ///< settings whose numbers multiply to more are left out
  std::vector<Measure> measures;
  std::string broadphase = "boxstream";
  double scale = 1;
  std::uint64_t steps = 0;  ///< of the scene as it is: all settings simulate the same time; 0: as many as it says
  int repeats = 9;          ///< timed runs of each setting
  /// Makes the trajectory that others are compared with: a frame after each of `steps` steps of the scene as it is, and
  /// contacts if it has any. None: the same engine with `reference_substeps`.
  std::function<Trajectory(const scenes::Scene& scene, std::uint64_t steps)> reference{};
  std::optional<Expected> expected{};
  std::optional<Settling> settling{};  ///< before all settings; none: measured from where the scene's file has bodies
  bool keep_values = false;            ///< of all steps, in Row::values
};

struct Row {
  Setting setting;
  std::string label;
  std::uint64_t steps = 0;
  std::vector<Series> series;               ///< one for each measure
  std::vector<std::vector<double>> values;  ///< of each measure, after each step; only if they were to be kept
  measure::Estimate ms;  ///< for a second of simulated time: processor time; of several threads elapsed time
  std::string failure;   ///< why the numbers are void; empty: they are valid
};

struct Sweep {
  scenes::Meta scene;
  std::vector<Row> rows;
  std::optional<std::size_t> own;  ///< the row whose values the scene has by itself, if one was measured
  double seconds = 0;              ///< simulated in each run
  double control_spread = 0;       ///< see measure::Costs
};

/// Called before each run with what it is.
using Progress = std::function<void(std::size_t done, std::size_t all, const std::string& what)>;

/// Runs the scene with every setting: once to sample each step, and `repeats` times for the clock, interleaved with an
/// A/A control. Throws BadKnob, scenes::SceneError (a value that the scene cannot have).
Sweep run(const Request& request, const Progress& progress);

/// The scene with one setting (or none), settled if the request says so, with as many steps as take the time of the
/// request. Throws as `run`.
scenes::Scene scene_with(const Request& request, const Setting& setting);

}  // namespace boxstream::accuracy
