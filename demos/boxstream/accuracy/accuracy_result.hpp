// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/work_precision.hpp"

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
/// Its place in request.measures; there is one.
std::size_t place_of_judge(const AccuracyResult& result);

/// Places of the settings that no other beats in both time and what they are judged by.
std::vector<std::size_t> front_of(const AccuracyResult& result);
bool on_front(const AccuracyResult& result, std::size_t row);

/// Whether the error of a measure is another number than its value.
bool has_own_error(const AccuracyResult& result, std::size_t measure);

/// The bound of a measure: that of the one that settings are judged by.
std::optional<double> bound_of(const AccuracyResult& result, std::size_t measure);

/// By how much the reference may be off in a measure, of the first run that knows it; 0: not known.
double band_of(const AccuracyResult& result, std::size_t measure);

/// The place of the setting to take: the cheapest sound one within the bound.
std::optional<std::size_t> advised(const AccuracyResult& result);

/// What a reader has to know about a measure: (its name, what would follow it in a sentence).
std::vector<std::pair<std::string, std::string>> notes(const AccuracyResult& result);

/// What the runs say, (a word, its text): the reference and how far it can be trusted, orders of convergence, what the
/// bound costs on each line, and the setting to take.
std::vector<std::pair<std::string, std::string>> findings(const AccuracyResult& result);

/// Whether less time was simulated than the scene asks for, because the budget allows no more.
bool is_shortened(const AccuracyResult& result);

/// How long, how often and on what settings were run.
std::string run_text(const AccuracyResult& result);

}  // namespace boxstream::tool
