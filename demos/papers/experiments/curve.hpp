// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/inputs.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/hybrid/hybrid_search.hpp"

namespace boxstream::papers {

/// A version on one input, beside the engine on the same.
struct Subject {
  Measured engine;
  /// Throws std::runtime_error unless it finds the engine's pairs.
  std::function<Measured(int repeats, Cutoffs cutoffs)> run;
};

/// Version Three, in the order of dimensions that the settings say.
Subject version_three_on(const Settings& settings, BipartiteInput input);
/// Version One, sorting of structures included, in the order of dimensions that the settings say.
Subject version_one_on(const Settings& settings, Input input);

/// A version over its cutoff, on one input.
struct Curve {
  double engine_ms;
  Row best{}, worst{};
  double at_2000 = 0;  ///< 0: not measured
};

/// Adds a row for each cutoff, and the engine as a level line from the first to the last, called `engine_name` and
/// `level`.
Curve curve_over(const std::vector<std::size_t>& cutoffs, const Settings& settings, const Subject& subject,
                 std::size_t n, const std::string& series, const std::string& level, std::vector<Row>& rows);

}  // namespace boxstream::papers
