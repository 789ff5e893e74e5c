// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace boxstream::tool {
namespace {

using accuracy::Row;

/// Of what settings are judged by.
double judged_error(const AccuracyResult& result, const Row& row) {
  return accuracy::error_of(result.request, result.sweep, row, place_of_judge(result));
}

/// What a line of the plot stands for: the setting without its last knob.
std::string series_name(const AccuracyResult& result, const Row& row) {
  const accuracy::Setting but_last(row.setting.begin(), row.setting.end() - 1);
  return but_last.empty() ? result.request.knobs.back().name : accuracy::label(result.request.knobs, but_last);
}

/// The edge between what can be had and what cannot.
picture::PlotLine front_line(const AccuracyResult& result) {
  picture::PlotLine line{"front", false, {}, picture::Colour{0.65F, 0.68F, 0.72F}};
  for (const std::size_t i : result.front) {
    const Row& row = result.sweep.rows[i];
    const double error = judged_error(result, row);
    if (!line.points.empty()) line.points.push_back({row.ms.median, line.points.back().y});
    line.points.push_back({row.ms.median, error});
  }
  return line;
}

}  // namespace

picture::Plot accuracy_plot(const AccuracyResult& result) {
  const std::string error = judge(result)->name;
  picture::Plot plot;
  plot.title = fmt::format("{}: {} against time", result.sweep.scene.name, error);
  plot.unit = error + (has_own_error(result, place_of_judge(result)) ? ", how far off" : ", worst of all steps");
  plot.small_print = run_text(result);
  plot.x_label = "ms for a simulated second; numbers beside points: " + result.request.knobs.back().name;

  std::map<std::string, picture::PlotLine> lines;
  bool positive = true;
  for (const Row& row : result.sweep.rows) {
    const std::string name = series_name(result, row);
    picture::PlotLine& line = lines[name];
    line.name = name;
    const double worst = judged_error(result, row);
    const bool failed = !row.may_be_advised() || !std::isfinite(worst);
    positive = positive && (failed || worst > 0);
    line.points.push_back({row.ms.median, failed ? 1 : worst,
                           accuracy::text_of(result.request.knobs.back(), row.setting.back()), failed});
  }
  for (auto& [name, line] : lines) plot.lines.push_back(std::move(line));
  if (result.front.size() > 1) plot.lines.push_back(front_line(result));
  const auto level = [&](const std::string& name, double y, const picture::Colour& colour) {
    const auto [low, high] = std::minmax_element(result.sweep.rows.begin(), result.sweep.rows.end(),
                                                 [](const Row& a, const Row& b) { return a.ms.median < b.ms.median; });
    plot.lines.push_back({name, false, {{low->ms.median, y}, {high->ms.median, y}}, colour});
  };
  if (result.bound) level("bound", *result.bound, {0.2F, 0.55F, 0.3F});
  if (const double band = band_of(result, place_of_judge(result)); band > 0)
    level("what the reference cannot tell", band, {0.8F, 0.6F, 0.3F});
  if (!positive) plot.y = picture::Axis::linear;
  return plot;
}

}  // namespace boxstream::tool
