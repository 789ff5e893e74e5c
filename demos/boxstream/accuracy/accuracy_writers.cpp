// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_writers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "base/words.hpp"
#include "boxstream/shared/report.hpp"

namespace boxstream::tool {
namespace {

using accuracy::Row;
using accuracy::Series;

std::string text_of(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

/// As a field of CSV.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

nlohmann::ordered_json vitals_json(const scenes::Vitals& vitals) {
  return {{"deepest", vitals.deepest},           {"deepest_share", vitals.deepest_share},
          {"joint_gap", vitals.joint_gap},       {"energy_gained", vitals.most_gained},
          {"energy_lost", vitals.energy.lost()}, {"energy_vanished", vitals.conserves ? vitals.vanished : 0},
          {"bodies_outside", vitals.outside},    {"elsewhere", vitals.elsewhere},
          {"height_loss", vitals.height_loss},   {"failed_checks", vitals.failed_checks}};
}

nlohmann::ordered_json reference_json(const AccuracyResult& result) {
  const accuracy::Reference& reference = result.sweep.reference;
  if (!reference.failure.empty()) return {{"failure", reference.failure}};
  if (reference.name.empty()) return nullptr;
  nlohmann::ordered_json document{{"name", reference.name}, {"holds", std::min(reference.holds, result.sweep.seconds)}};
  if (reference.is_estimated()) document["error"] = reference.error.back();
  for (std::size_t m = 0; m < reference.series.size(); ++m)
    document["measures"][result.request.measures[m].name] = {
        {"value", reference.series[m].of(result.request.measures[m])},
        {"spread", m < reference.spread.size() ? reference.spread[m] : NAN}};
  return document;
}

std::string error_text(const AccuracyResult& result, std::size_t row) {
  const std::size_t m = place_of_judge(result);
  const accuracy::ErrorInterval error = accuracy::error_interval(result.request, result.sweep, row, m);
  if (std::isnan(error.value)) return "-";
  const double band = result.sweep.rows[row].bands.empty() ? NAN : result.sweep.rows[row].bands[m];
  if (!std::isfinite(band)) return fmt::format("{:.3g}", error.value);
  return error.value <= band ? fmt::format("< {:.2g}", band) : fmt::format("{:.3g} ± {:.1g}", error.value, band);
}

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

std::string accuracy_csv(const AccuracyResult& result) {
  std::string out;
  for (const accuracy::Knob& knob : result.request.knobs) out += knob.name + ",";
  out += "steps,ms_per_s,ms_per_s_low,ms_per_s_high";
  for (const accuracy::Measure& measure : result.request.measures)
    for (const char* part : {"worst", "p95", "mean", "last", "integral"})
      out += fmt::format(",{}_{}", measure.name, part);
  out += ",error,band,front,failure,unsound\n";
  for (std::size_t i = 0; i < result.sweep.rows.size(); ++i) {
    const Row& row = result.sweep.rows[i];
    for (const nlohmann::json& value : row.setting) out += text_of(value) + ",";
    out += fmt::format("{},{},{},{}", row.steps, row.ms.median, row.ms.low, row.ms.high);
    for (const Series& s : row.series)
      out += fmt::format(",{},{},{},{},{}", s.worst, s.p95, s.mean, s.last, s.integral);
    const bool judged = judge(result) != nullptr && !row.series.empty();
    out += fmt::format(",{},{},{},{},{}\n",
                       judged ? accuracy::error_of(result.request, result.sweep, row, place_of_judge(result)) : NAN,
                       judged && !row.bands.empty() ? row.bands[place_of_judge(result)] : NAN,
                       on_front(result, i) ? 1 : 0, csv_field(row.failure), csv_field(row.unsound));
  }
  return out;
}

nlohmann::ordered_json precision_json(const AccuracyResult& result, std::size_t measure) {
  using nlohmann::ordered_json;
  const std::optional<double> bound = bound_of(result, measure);
  ordered_json lines = ordered_json::array();
  for (const accuracy::Line& line : accuracy::lines_of(result.request, result.sweep)) {
    ordered_json entry{{"name", line.name}, {"order", nullptr}, {"cost_at_bound", nullptr}};
    if (const auto order = accuracy::order_of_convergence(result.request, result.sweep, line, measure))
      entry["order"] = *order;
    if (const auto cost = bound ? accuracy::cost_at(result.request, result.sweep, line, measure, *bound) : std::nullopt)
      entry["cost_at_bound"] = {{"median", cost->median}, {"low", cost->low}, {"high", cost->high}};
    lines.push_back(std::move(entry));
  }
  return {{"bound", bound ? ordered_json(*bound) : ordered_json(nullptr)},
          {"band", band_of(result, measure)},
          {"lines", lines}};
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
    for (const std::size_t m : row.series.empty() ? std::vector<std::size_t>() : applicable(result)) {
      const accuracy::ErrorInterval error = accuracy::error_interval(result.request, result.sweep, i, m);
      entry["errors"][result.request.measures[m].name] = {
          {"value", error.value}, {"low", error.low}, {"high", error.high}};
    }
    entry["vitals"] = vitals_json(row.vitals);
    if (!row.failure.empty()) entry["failure"] = row.failure;
    if (!row.unsound.empty()) entry["unsound"] = row.unsound;
    rows.push_back(std::move(entry));
  }
  ordered_json precisions = ordered_json::object();
  for (const std::size_t m : applicable(result))
    precisions[result.request.measures[m].name] = precision_json(result, m);
  const auto best = advised(result);
  const ordered_json document{{"format", 2},
                              {"scene", result.sweep.scene.name},
                              {"file", result.request.file},
                              {"broadphase", result.request.broadphase},
                              {"seconds", result.sweep.seconds},
                              {"seconds_of_scene", result.sweep.seconds_of_scene},
                              {"settled_steps", result.request.settling ? result.request.settling->steps : 0},
                              {"repeats", result.request.repeats},
                              {"twin_spread", result.sweep.control_spread},
                              {"stopped", result.sweep.stopped},
                              {"machine", cpu_name()},
                              {"compiler", compiler_name()},
                              {"reference", reference_json(result)},
                              {"precision", precisions},
                              {"advice", best ? ordered_json(result.sweep.rows[*best].label) : ordered_json(nullptr)},
                              {"settings", rows}};
  return json_dump(document, 2) + "\n";
}

std::string accuracy_table(const AccuracyResult& result) {
  std::size_t width = 8;
  for (const Row& row : result.sweep.rows) width = std::max(width, row.label.size());
  std::string out = fmt::format("scene    {}: {}\n         {}\n\n  {:<{}}  {:>9}  {:>17}",
                                files::printable(result.sweep.scene.name), files::printable(result.sweep.scene.about),
                                run_text(result), "setting", width, "ms per s", "95 % interval");
  const std::vector<std::size_t> columns = applicable(result);
  for (const std::size_t m : columns) out += fmt::format("  {:>14}", result.request.measures[m].name);
  const bool with_error = judge(result) != nullptr && has_own_error(result, place_of_judge(result));
  if (with_error) out += fmt::format("  {:>18}", "off by");
  out += "\n";
  const auto to = std::back_inserter(out);
  for (std::size_t i = 0; i < result.sweep.rows.size(); ++i) {
    const Row& row = result.sweep.rows[i];
    fmt::format_to(to, "{} {:<{}}  {:>9.4g}  {:>17}",
                   !row.may_be_advised() ? '!'
                   : on_front(result, i) ? '*'
                                         : ' ',
                   row.label, width, row.ms.median, fmt::format("{:.4g} - {:.4g}", row.ms.low, row.ms.high));
    for (const std::size_t m : columns) {
      const double value = row.series[m].of(result.request.measures[m]);
      fmt::format_to(to, "  {:>14}", std::isnan(value) ? "-" : fmt::format("{:.4g}", value));
    }
    if (with_error) fmt::format_to(to, "  {:>18}", error_text(result, i));
    if (!row.failure.empty())
      out += fmt::format("  failed: {}", files::printable(row.failure));
    else if (!row.unsound.empty())
      out += fmt::format("  {}", files::printable(row.unsound));
    out += "\n";
  }
  out += "\n";
  if (const accuracy::Measure* const measure = judge(result)) {
    fmt::format_to(to,
                   "* no other sound setting is better in both time and {}; ! not sound, whatever its numbers; values "
                   "are the worst of all steps unless the name says otherwise\n",
                   measure->name);
    for (const auto& [word, text] : findings(result)) fmt::format_to(to, "{:<10} {}\n", word, files::printable(text));
  }
  if (result.sweep.all_settings > result.sweep.rows.size())
    fmt::format_to(to, "{} of {} settings were tried\n", result.sweep.rows.size(), result.sweep.all_settings);
  if (result.sweep.stopped) out += "stopped before all was measured\n";
  if (result.sweep.turns == 0)
    out += "times are those of the runs that were measured: there was no time left to time settings by turns\n";
  for (const auto& [name, text] : notes(result)) fmt::format_to(to, "{} {}\n", name, text);
  if (result.sweep.control_spread > 0.03)
    out += "the machine was busy: differences below that of the two controls are not significant\n";
  return out;
}

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
