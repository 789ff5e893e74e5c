// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "sweep.hpp"

namespace boxstream::accuracy {

/// Error of a row as far as it is known: the reference, or the truth, may be off by the band.
struct ErrorInterval {
  double low = 0, value = 0, high = 0;
};

/// NaN where nothing is known. Errors below the band are not told from each other: `low` is 0 then.
ErrorInterval error_interval(const Request& request, const Sweep& sweep, std::size_t row, std::size_t measure);

/// Rows that differ in the last knob alone, in the order of its values: a line of the plot.
struct Line {
  std::string name;               ///< of the other knobs; empty: there is none
  std::vector<std::size_t> rows;  ///< indices into the sweep's
};
std::vector<Line> lines_of(const Request& request, const Sweep& sweep);

/// The slope of log error against log step, where the last knob is a step, substeps or iterations: 2 says that half the
/// step has a quarter of the error. Of sound rows whose error is more than twice the band; none where there are fewer
/// than three, or nothing falls.
std::optional<double> order_of_convergence(const Request& request, const Sweep& sweep, const Line& line,
                                           std::size_t measure);

/// What a line costs at a given error.
struct CostAt {
  double median = 0, low = 0, high = 0;  ///< ms for a simulated second
  bool is_measured = false;              ///< at a row that needs no interpolation: the cheapest one is good enough
};

/// Between the two neighbours on a line of which one has more than `bound` and the other has not, straight on
/// logarithmic axes; the interval is that of their costs and of their errors. None where no sound row is good enough.
std::optional<CostAt> cost_at(const Request& request, const Sweep& sweep, const Line& line, std::size_t measure,
                              double bound);

/// Rows that are sound and that no other sound row beats in cost and error; errors that the reference cannot tell apart
/// are equal, and so are costs whose intervals overlap where errors are equal too. By increasing cost.
std::vector<std::size_t> front_of(const Request& request, const Sweep& sweep, std::size_t measure);

/// The cheapest sound row whose error is at most `bound`.
std::optional<std::size_t> cheapest_within(const Request& request, const Sweep& sweep, std::size_t measure,
                                           double bound);

/// "5mm", "0.2 %", "3deg", "0.01": in the unit of measures, m, degrees, shares. Throws BadKnob.
double parse_bound(const std::string& text);

}  // namespace boxstream::accuracy
