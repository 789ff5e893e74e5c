// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "measure.hpp"
#include "simulation/run/vitals.hpp"
#include "trajectory.hpp"

namespace boxstream::accuracy {

/// What runs are compared with, and how far it can be trusted.
struct Reference {
  Trajectory trajectory;       ///< empty: there is none
  double dt = 0;               ///< between its frames
  std::string name;            ///< what made it
  std::string failure;         ///< why there is none, or none that can be trusted
  std::string remark{};        ///< what there is to know about it
  std::vector<Series> series;  ///< of each measure that the request asks for; empty: not known
  scenes::Vitals vitals;
  bool stands_alike = false;   ///< all runs of the sequence agree about what falls
  bool loses_alike = false;    ///< all runs of the sequence agree about the energy that is lost
  std::vector<double> spread;  ///< by how much the last two runs of the sequence differ in each
  /// Of each frame, by the sequence: m and degrees. Empty: not estimated.
  std::vector<double> error, angle_error;
  /// s; later the runs of the sequence part, so that there is no one answer: chaos, or several solutions.
  double holds = std::numeric_limits<double>::infinity();

  bool is_estimated() const { return !error.empty(); }
};

/// A run of the sequence: the same engine with finer and finer steps.
struct Member {
  int substeps = 0;
  Trajectory trajectory;
  std::vector<Series> series;
  scenes::Vitals vitals;
  std::string failure;
};

/// What the last of at least two runs says, and by how much it may be off: where distances between successive runs
/// shrink by a ratio r > 1.5, the last distance over r - 1 (Richardson), elsewhere the larger of the last two.
/// Three runs at least make an estimate of the order; two give their distance alone.
Reference estimated(const std::vector<Member>& sequence, const std::vector<Measure>& measures, double dt);

/// Share of the way that bodies have gone, or of a tenth of their size if that is more, which a reference may be off
/// by, and still be one.
inline constexpr double most_reference_error = 0.1;

}  // namespace boxstream::accuracy
