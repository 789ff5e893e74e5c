// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/work_precision.hpp"
#include "pictures/drawing/plot.hpp"

namespace boxstream::tool {

/// A sweep and its request.
struct AccuracyResult {
  accuracy::Request request;
  accuracy::Sweep sweep;
  std::string page_command{};     ///< for a shell: makes the page again
  std::optional<double> bound{};  ///< of the error of what settings are judged by
  /// Places in sweep.rows of sound settings that no other beats in both time and what they are judged by, by time.
  std::vector<std::size_t> front{};
};

/// Places in request.measures of those that apply to the scene: that have a number in a run that did not fail. Where
/// all runs failed, all of them.
std::vector<std::size_t> applicable(const AccuracyResult& result);

/// What settings are judged by: the first measure that applies. None: none does.
const accuracy::Measure* judge(const AccuracyResult& result);

/// Places of the settings that no other beats in both time and what they are judged by.
std::vector<std::size_t> front_of(const AccuracyResult& result);

/// What a reader has to know about a measure: (its name, what would follow it in a sentence).
std::vector<std::pair<std::string, std::string>> notes(const AccuracyResult& result);

/// For reading; ends in a newline.
std::string accuracy_table(const AccuracyResult& result);
/// A row for each setting, a column for each knob, each measure (worst, p95, mean, last) and the times.
std::string accuracy_csv(const AccuracyResult& result);
std::string accuracy_json(const AccuracyResult& result);
/// Time against what settings are judged by, of which there is one: a line for each combination of all knobs but the
/// last, the last one's values beside the points, and the front.
picture::Plot accuracy_plot(const AccuracyResult& result);

}  // namespace boxstream::tool
