// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "base/printable.hpp"
#include "boxstream/shared/json_dump.hpp"
#include "boxstream/shared/machine.hpp"

namespace boxstream::tool {
namespace {

using accuracy::Row;
using accuracy::Series;

std::string text_of(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

bool on_front(const AccuracyResult& result, std::size_t row) {
  return std::find(result.front.begin(), result.front.end(), row) != result.front.end();
}

std::string run_text(const AccuracyResult& result) {
  const std::string settled =
      result.request.settling ? fmt::format(" after {} steps to come to rest", result.request.settling->steps) : "";
  return fmt::format(
      "{:.4g} s simulated{} on {}, median of {} runs, two series of the first setting differ by {:.1f} %",
      result.sweep.seconds, settled, result.request.broadphase, result.request.repeats,
      100 * result.sweep.control_spread);
}

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

/// Of what settings are judged by.
double judged_value(const AccuracyResult& result, const Row& row) {
  const accuracy::Measure& measure = *judge(result);
  return row.series[static_cast<std::size_t>(&measure - result.request.measures.data())].of(measure);
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
    const double error = judged_value(result, row);
    if (!line.points.empty()) line.points.push_back({row.ms.median, line.points.back().y});
    line.points.push_back({row.ms.median, error});
  }
  return line;
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

std::vector<std::size_t> front_of(const AccuracyResult& result) {
  const accuracy::Measure* const measure = judge(result);
  if (measure == nullptr) return {};
  std::vector<accuracy::Offer> offers;
  for (const Row& row : result.sweep.rows) {
    const double value = row.failure.empty() ? judged_value(result, row) : std::nan("");
    const double error = better(*measure) == accuracy::Better::high        ? -value
                         : better(*measure) == accuracy::Better::near_zero ? std::abs(value)
                                                                           : value;
    offers.push_back({row.ms.median, error});
  }
  return accuracy::front(offers);
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

std::string accuracy_table(const AccuracyResult& result) {
  std::size_t width = 8;
  for (const Row& row : result.sweep.rows) width = std::max(width, row.label.size());
  std::string out = fmt::format("scene    {}: {}\n         {}\n\n  {:<{}}  {:>9}  {:>17}",
                                files::printable(result.sweep.scene.name), files::printable(result.sweep.scene.about),
                                run_text(result), "setting", width, "ms per s", "95 % interval");
  const std::vector<std::size_t> columns = applicable(result);
  for (const std::size_t m : columns) out += fmt::format("  {:>14}", result.request.measures[m].name);
  out += "\n";
  const auto to = std::back_inserter(out);
  for (std::size_t i = 0; i < result.sweep.rows.size(); ++i) {
    const Row& row = result.sweep.rows[i];
    fmt::format_to(to, "{} {:<{}}  {:>9.4g}  {:>17}", on_front(result, i) ? '*' : ' ', row.label, width, row.ms.median,
                   fmt::format("{:.4g} - {:.4g}", row.ms.low, row.ms.high));
    for (const std::size_t m : columns) {
      const double value = row.series[m].of(result.request.measures[m]);
      fmt::format_to(to, "  {:>14}", std::isnan(value) ? "-" : fmt::format("{:.4g}", value));
    }
    out += row.failure.empty() ? "\n" : fmt::format("  failed: {}\n", files::printable(row.failure));
  }
  out += "\n";
  if (const accuracy::Measure* const measure = judge(result))
    fmt::format_to(to,
                   "* no other setting is better in both time and {}; values are the worst of all steps unless the "
                   "name says otherwise\n",
                   measure->name);
  for (const auto& [name, text] : notes(result)) fmt::format_to(to, "{} {}\n", name, text);
  if (result.sweep.control_spread > 0.03)
    out += "the machine was busy: differences below that of the two controls are not significant\n";
  return out;
}

std::string accuracy_csv(const AccuracyResult& result) {
  std::string out;
  for (const accuracy::Knob& knob : result.request.knobs) out += knob.name + ",";
  out += "steps,ms_per_s,ms_per_s_low,ms_per_s_high";
  for (const accuracy::Measure& measure : result.request.measures)
    for (const char* part : {"worst", "p95", "mean", "last", "integral"})
      out += fmt::format(",{}_{}", measure.name, part);
  out += ",front,failure\n";
  for (std::size_t i = 0; i < result.sweep.rows.size(); ++i) {
    const Row& row = result.sweep.rows[i];
    for (const nlohmann::json& value : row.setting) out += text_of(value) + ",";
    out += fmt::format("{},{},{},{}", row.steps, row.ms.median, row.ms.low, row.ms.high);
    for (const Series& s : row.series)
      out += fmt::format(",{},{},{},{},{}", s.worst, s.p95, s.mean, s.last, s.integral);
    out += fmt::format(",{},{}\n", on_front(result, i) ? 1 : 0, row.failure);
  }
  return out;
}

std::string accuracy_json(const AccuracyResult& result) {
  using nlohmann::ordered_json;
  ordered_json rows = ordered_json::array();
  for (std::size_t i = 0; i < result.sweep.rows.size(); ++i) {
    const Row& row = result.sweep.rows[i];
    ordered_json knobs = ordered_json::object(), measures = ordered_json::object();
    for (std::size_t k = 0; k < row.setting.size(); ++k) knobs[result.request.knobs[k].name] = row.setting[k];
    for (std::size_t m = 0; m < row.series.size(); ++m) {
      const Series& s = row.series[m];
      measures[result.request.measures[m].name] = {
          {"worst", s.worst}, {"p95", s.p95}, {"mean", s.mean}, {"last", s.last}, {"integral", s.integral}};
    }
    ordered_json entry{{"knobs", knobs},
                       {"steps", row.steps},
                       {"ms_per_s", {{"median", row.ms.median}, {"low", row.ms.low}, {"high", row.ms.high}}},
                       {"measures", measures},
                       {"front", on_front(result, i)}};
    if (!row.failure.empty()) entry["failure"] = row.failure;
    rows.push_back(std::move(entry));
  }
  const ordered_json document{{"format", 1},
                              {"scene", result.sweep.scene.name},
                              {"file", result.request.file},
                              {"broadphase", result.request.broadphase},
                              {"seconds", result.sweep.seconds},
                              {"settled_steps", result.request.settling ? result.request.settling->steps : 0},
                              {"repeats", result.request.repeats},
                              {"twin_spread", result.sweep.control_spread},
                              {"machine", cpu_name()},
                              {"compiler", compiler_name()},
                              {"settings", rows}};
  return json_dump(document, 2) + "\n";
}

picture::Plot accuracy_plot(const AccuracyResult& result) {
  const std::string error = judge(result)->name;
  picture::Plot plot;
  plot.title = fmt::format("{}: {} against time", result.sweep.scene.name, error);
  plot.unit = error + ", worst of all steps";
  plot.small_print = run_text(result);
  plot.x_label = "ms for a simulated second; numbers beside points: " + result.request.knobs.back().name;

  std::map<std::string, picture::PlotLine> lines;
  bool positive = true;
  for (const Row& row : result.sweep.rows) {
    const std::string name = series_name(result, row);
    picture::PlotLine& line = lines[name];
    line.name = name;
    const double worst = judged_value(result, row);
    const bool failed = !row.failure.empty() || !std::isfinite(worst);
    positive = positive && (failed || worst > 0);
    line.points.push_back({row.ms.median, failed ? 1 : worst, text_of(row.setting.back()), failed});
  }
  for (auto& [name, line] : lines) plot.lines.push_back(std::move(line));
  if (result.front.size() > 1) plot.lines.push_back(front_line(result));
  if (!positive) plot.y = picture::Axis::linear;
  return plot;
}

}  // namespace boxstream::tool
