// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "knob.hpp"
#include "scene/checks.hpp"
#include "scene/settings.hpp"
#include "statistics.hpp"

namespace boxstream::accuracy {

/// What is measured of a run.
struct Measure {
  enum class Kind {
    metric,     ///< one of scenes::metric_names(), after each step
    trajectory  ///< metres that dynamic bodies are from where a run with `reference_substeps` has them, at the end
                ///< (RMS)
  };
  std::string name;
  Kind kind = Kind::metric;
  scenes::Check::Metric metric = scenes::Check::Metric::finite;
};

inline constexpr int reference_substeps = 64;

/// A name of scenes::metric_names(), "penetration" for "max_penetration", or "trajectory". Throws BadKnob.
Measure parse_measure(const std::string& name);

struct Request {
  std::string file;         ///< of the scene, for messages and for files that it names
  nlohmann::json scene;     ///< its text; checks and outputs in it are left out
  std::vector<Knob> knobs;  ///< at least one
  std::vector<Measure> measures;
  std::string broadphase = "boxstream";
  double scale = 1;
  std::uint64_t steps = 0;  ///< of the scene as it is: all settings simulate the same time; 0: as many as it says
  int repeats = 9;          ///< timed runs of each setting
};

/// Of one measure over the steps of a run.
struct Series {
  double worst = 0;  ///< the largest; of "lowest" and "finite" the smallest
  double p95 = 0;
  double mean = 0;
  double last = 0;
};

struct Row {
  Setting setting;
  std::string label;
  std::uint64_t steps = 0;
  std::vector<Series> series;  ///< one for each measure
  Estimate ms;                 ///< for a second of simulated time: processor time; of several threads elapsed time
  std::string failure;         ///< why the numbers count for nothing; empty: they count
};

struct Sweep {
  scenes::Meta scene;
  std::vector<Row> rows;
  double seconds = 0;      ///< simulated in each run
  double twin_spread = 0;  ///< see Turns
};

/// Called before each run with what it is.
using Progress = std::function<void(std::size_t done, std::size_t all, const std::string& what)>;

/// Runs the scene with every setting: once to look at it, step by step, and `repeats` times for the clock, settings
/// taking turns, forwards and backwards. Throws BadKnob, scenes::SceneError (a value that the scene cannot have).
Sweep run(const Request& request, const Progress& progress);

}  // namespace boxstream::accuracy
