// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "accuracy/sweep.hpp"
#include "pictures/drawing/plot.hpp"

namespace boxstream::tool {

/// A sweep and its request.
struct AccuracyResult {
  accuracy::Request request;
  accuracy::Sweep sweep;
  /// Places in sweep.rows of settings that no other beats in both time and the first measure, by time.
  std::vector<std::size_t> front;
};

/// For reading; ends in a newline.
std::string accuracy_table(const AccuracyResult& result);
/// A row for each setting, a column for each knob, each measure (worst, p95, mean, last) and the times.
std::string accuracy_csv(const AccuracyResult& result);
std::string accuracy_json(const AccuracyResult& result);
/// Time against the worst of the first measure: a line for each combination of all knobs but the last, the last one's
/// values beside the points, and the front.
picture::Plot accuracy_plot(const AccuracyResult& result);

}  // namespace boxstream::tool
