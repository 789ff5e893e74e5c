// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "measure/interleave.hpp"

namespace boxstream::report {

/// One setting of one candidate: its cost and its metrics.
struct Point {
  std::string panel{};           ///< the scene or input; a plot each
  std::string series{};          ///< the candidate: all but the knob
  std::string setting{};         ///< the value of the knob, as a label
  double x = NAN;                ///< the same as a number, where it is one
  measure::Estimate cost{};      ///< in the unit of the results; instructions of the whole timed region
  std::vector<double> values{};  ///< one for each metric of the results; NaN: does not apply
  std::string failure{};         ///< why the numbers are void; drawn as a cross
};

/// A value over time (or steps), for plots of how runs diverge.
struct Curve {
  std::string panel, series, setting;
  std::vector<std::pair<double, double>> points;
};

/// The A/A control of one panel: by how much two series of the same candidate differ, |a / b - 1| of their medians.
struct ControlSpread {
  std::string panel;
  double spread = 0;
};

struct Results {
  std::string cost_unit;             ///< "ms per simulated second"
  std::vector<std::string> metrics;  ///< with their units where they have one: "penetration_m"
  std::vector<Point> points;
  std::vector<Curve> curves;
  std::vector<ControlSpread> controls;
};

}  // namespace boxstream::report
