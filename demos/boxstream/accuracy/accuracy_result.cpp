// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxstream::tool {
namespace {

using accuracy::Row;

/// Of the runs that did not fail.
std::vector<double> values_of(const AccuracyResult& result, std::size_t measure) {
  std::vector<double> values;
  for (const Row& row : result.sweep.rows)
    if (row.failure.empty()) values.push_back(row.series[measure].of(result.request.measures[measure]));
  return values;
}

bool applies(const AccuracyResult& result, std::size_t measure) {
  const std::vector<double> values = values_of(result, measure);
  return values.empty() || std::any_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

/// Is it an error that is the same at all settings, to 5 %?
bool is_unmoved(const AccuracyResult& result, std::size_t measure) {
  const std::vector<double> values = values_of(result, measure);
  if (values.size() < 2 || better(result.request.measures[measure]) != accuracy::Better::low) return false;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most > 0 && *most - *least <= 0.05 * *most;
}

}  // namespace

std::vector<std::size_t> applicable(const AccuracyResult& result) {
  std::vector<std::size_t> places;
  for (std::size_t m = 0; m < result.request.measures.size(); ++m)
    if (applies(result, m)) places.push_back(m);
  return places;
}

const accuracy::Measure* judge(const AccuracyResult& result) {
  const std::vector<std::size_t> places = applicable(result);
  return places.empty() ? nullptr : &result.request.measures[places.front()];
}

std::size_t place_of_judge(const AccuracyResult& result) {
  return static_cast<std::size_t>(judge(result) - result.request.measures.data());
}

std::vector<std::size_t> front_of(const AccuracyResult& result) {
  if (judge(result) == nullptr) return {};
  return accuracy::front_of(result.request, result.sweep, place_of_judge(result));
}

bool on_front(const AccuracyResult& result, std::size_t row) {
  return std::find(result.front.begin(), result.front.end(), row) != result.front.end();
}

bool has_own_error(const AccuracyResult& result, std::size_t measure) {
  return better(result.request.measures[measure]) == accuracy::Better::as_reference ||
         (measure == 0 && result.request.truth.value.has_value());
}

std::optional<double> bound_of(const AccuracyResult& result, std::size_t measure) {
  const bool judges = judge(result) != nullptr && measure == place_of_judge(result);
  return judges ? result.bound : std::nullopt;
}

double band_of(const AccuracyResult& result, std::size_t measure) {
  for (const Row& row : result.sweep.rows)
    if (measure < row.bands.size() && std::isfinite(row.bands[measure])) return row.bands[measure];
  return 0;
}

std::optional<std::size_t> advised(const AccuracyResult& result) {
  if (judge(result) == nullptr) return std::nullopt;
  const double bound = result.bound.value_or(std::numeric_limits<double>::infinity());
  return accuracy::cheapest_within(result.request, result.sweep, place_of_judge(result), bound);
}

std::vector<std::pair<std::string, std::string>> notes(const AccuracyResult& result) {
  std::vector<std::pair<std::string, std::string>> all;
  for (std::size_t m = 0; m < result.request.measures.size(); ++m) {
    const accuracy::Measure& measure = result.request.measures[m];
    if (!applies(result, m)) {
      const std::string needed = accuracy::needs(measure);
      all.emplace_back(measure.name, "does not apply to this scene" + (needed.empty() ? "" : ": it needs " + needed));
    } else if (is_unmoved(result, m)) {
      all.emplace_back(measure.name, result.request.settling
                                         ? "is the same at all settings, to 5 %: they do not matter for it here"
                                         : "is the same at all settings, to 5 %: they do not matter for it here, or it "
                                           "measures the start, such as a fall before the first contact; --settle "
                                           "measures after the scene has come to rest");
    }
  }
  return all;
}

bool is_shortened(const AccuracyResult& result) {
  return result.sweep.seconds_of_scene > result.sweep.seconds;
}

std::string run_text(const AccuracyResult& result) {
  const std::string settled =
      result.request.settling ? fmt::format(" after {} steps to come to rest", result.request.settling->steps) : "";
  const std::string of =
      is_shortened(result) ? fmt::format(" of {:.4g} s", result.sweep.seconds_of_scene) : std::string();
  return fmt::format(
      "{:.4g} s simulated{}{} on {}, medians of {} runs or more{}", result.sweep.seconds, of, settled,
      result.request.broadphase, std::max(1, result.sweep.turns),
      std::isnan(result.sweep.control_spread)
          ? std::string()
          : fmt::format(", two series of the first setting differ by {:.1f} %", 100 * result.sweep.control_spread));
}

}  // namespace boxstream::tool
