// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "format/results.hpp"

namespace boxstream::report {

/// What the curve through `points` has at `cost`: a power law between each two neighbours by cost. NaN outside of the
/// costs of the points, which are those without a failure and with costs and errors above 0.
double error_at_cost(const std::vector<Point>& points, std::size_t metric, double cost);

/// For each point its error in `metric` divided by that which `series` has for the same cost: below 1 it beats it. NaN
/// for the series itself, and outside of its costs.
std::vector<double> errors_beside(const std::string& series, std::size_t metric, const std::vector<Point>& points);

}  // namespace boxstream::report
