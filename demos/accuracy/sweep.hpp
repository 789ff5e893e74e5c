// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "elsewhere.hpp"
#include "formats/scene_model/settings.hpp"
#include "front.hpp"
#include "knob.hpp"
#include "measure.hpp"
#include "measure/interleave.hpp"
#include "reference.hpp"
#include "settle.hpp"
#include "simulation/run/vitals.hpp"
#include "trajectory.hpp"
#include "truth.hpp"

namespace boxstream::scenes {
struct Scene;
}

namespace boxstream::accuracy {

/// Of the last run of the reference's sequence, unless settings are finer or time is short.
inline constexpr int reference_substeps = 128;

/// What a body's velocity is at the end, by a closed form.
struct Expected {
  std::size_t body = 0;  ///< its place among all objects
  std::array<double, 3> velocity{};
};

/// Not all settings, but the cheapest sound one whose first measure has an error of at most `bound`: from cheap to
/// expensive, until no other can be cheaper, or the budget is spent.
struct Seek {
  double bound = std::numeric_limits<double>::infinity();
};

struct Request {
  std::string file;                ///< of the scene, for messages and for files that it names
  nlohmann::json scene;            ///< its text; outputs in it are left out
  std::vector<Knob> knobs;         ///< at least one
  double most_product = HUGE_VAL;  ///< settings whose numbers multiply to more are left out
  std::vector<Measure> measures;
  std::string broadphase = "boxstream";
  double scale = 1;
  std::uint64_t steps = 0;  ///< of the scene as it is: all settings simulate the same time; 0: as many as it says
  int repeats = 9;          ///< timed runs of each setting, at most
  /// s, for everything. Every setting runs once; what is left goes into the reference and the clock. Where that takes
  /// longer and `steps` is 0, less time is simulated.
  double budget = std::numeric_limits<double>::infinity();
  /// Makes the trajectory that others are compared with: a frame after each of `steps` steps of the scene as it is, and
  /// contacts if it has any. None: `run_reference`, for measures that need one.
  std::function<Trajectory(const scenes::Scene& scene, std::uint64_t steps)> reference{};
  /// Run it too where no measure needs it, as far as the budget allows: it tells what stands from what falls.
  bool compare = false;
  std::optional<Expected> expected{};
  std::string body_name{};             ///< or number, of what measures of one body are of
  std::optional<std::size_t> body{};   ///< its place among all objects, which `run` finds
  std::string joint_name{};            ///< number, or names of its bodies, of what measures of joints are of
  std::optional<std::size_t> joint{};  ///< its place among all joints, which `run` finds
  /// What a run of the scene says, for measures that are fields of it.
  std::function<nlohmann::json(const scenes::Scene& scene)> document{};
  Elsewhere elsewhere{};  ///< for scenes in the other precision; none: they are refused
  Truth truth{};
  std::optional<Settling> settling{};  ///< before all settings; none: measured from where the scene's file has bodies
  std::optional<Seek> seek{};
  bool keep_values = false;      ///< of all steps, in Row::values
  std::function<bool()> stop{};  ///< asked now and then; true: ends with what was measured
};

struct Row {
  Setting setting;
  std::string label;
  std::uint64_t steps = 0;
  std::vector<Series> series;               ///< one for each measure
  std::vector<double> bands;                ///< by how much the reference may be off in each; NaN: not known
  std::vector<std::vector<double>> values;  ///< of each measure, after each step; only if they were to be kept
  measure::Estimate ms;  ///< for a second of simulated time: processor time; of several threads elapsed time
  scenes::Vitals vitals;
  std::string failure;  ///< why the numbers are void; empty: they are valid
  std::string unsound;  ///< what went wrong that its measures may not see; empty: nothing

  bool may_be_advised() const { return failure.empty() && unsound.empty(); }
};

struct Sweep {
  scenes::Meta scene;
  std::vector<Row> rows;
  std::optional<std::size_t> own;  ///< the row whose values the scene has by itself, if one was measured
  double seconds = 0;              ///< simulated in each run
  double seconds_of_scene = 0;     ///< that it asked for; more than `seconds`: the budget allows no more
  double control_spread = 0;       ///< see measure::Costs
  Reference reference;
  bool stopped = false;          ///< before all was measured
  std::size_t all_settings = 0;  ///< of which `rows` were tried
  int turns = 0;                 ///< of the clock, of the setting that had fewest; 0: timed while it was measured
};

struct Stage {
  std::size_t done = 0, all = 0;  ///< runs
  double seconds_left = NAN;      ///< about; NaN: not known yet
  std::string what;
};

/// Called before each run with what it is.
using Progress = std::function<void(const Stage&)>;

/// Runs the scene with every setting: once to sample each step, and up to `repeats` times for the clock, interleaved
/// with an A/A control, as long as settings are not told apart and time is left. Throws BadKnob, scenes::SceneError (a
/// value that the scene cannot have).
Sweep run(const Request& request, const Progress& progress);

/// How far a row is from right in a measure; smaller is better, whatever the measure's own sense. NaN: not known, or
/// the row is the reference itself.
double error_of(const Request& request, const Sweep& sweep, const Row& row, std::size_t measure);

/// The scene with one setting (or none), settled if the request says so, with as many steps as take the time of the
/// request. Throws as `run`.
scenes::Scene scene_with(const Request& request, const Setting& setting);

}  // namespace boxstream::accuracy
