// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
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

/// As a field of CSV.
std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

bool on_front(const AccuracyResult& result, std::size_t row) {
  return std::find(result.front.begin(), result.front.end(), row) != result.front.end();
}

std::string run_text(const AccuracyResult& result) {
  const std::string settled =
      result.request.settling ? fmt::format(" after {} steps to come to rest", result.request.settling->steps) : "";
  return fmt::format(
      "{:.4g} s simulated{} on {}, medians of {} runs or more{}", result.sweep.seconds, settled,
      result.request.broadphase, std::max(1, result.sweep.turns),
      std::isnan(result.sweep.control_spread)
          ? std::string()
          : fmt::format(", two series of the first setting differ by {:.1f} %", 100 * result.sweep.control_spread));
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

std::size_t place_of_judge(const AccuracyResult& result) {
  return static_cast<std::size_t>(judge(result) - result.request.measures.data());
}

/// Of what settings are judged by.
double judged_error(const AccuracyResult& result, const Row& row) {
  return accuracy::error_of(result.request, result.sweep, row, place_of_judge(result));
}

/// Whether its error is another number than its value.
bool has_own_error(const AccuracyResult& result) {
  return better(*judge(result)) == accuracy::Better::as_reference || result.request.truth.value.has_value();
}

std::string error_text(const AccuracyResult& result, std::size_t row) {
  const std::size_t m = place_of_judge(result);
  const accuracy::ErrorInterval error = accuracy::error_interval(result.request, result.sweep, row, m);
  if (std::isnan(error.value)) return "-";
  const double band = result.sweep.rows[row].bands.empty() ? NAN : result.sweep.rows[row].bands[m];
  if (!std::isfinite(band)) return fmt::format("{:.3g}", error.value);
  return error.value <= band ? fmt::format("< {:.2g}", band) : fmt::format("{:.3g} ± {:.1g}", error.value, band);
}

/// What the others are compared with, and how far that can be trusted.
std::string reference_lines(const AccuracyResult& result) {
  const accuracy::Reference& reference = result.sweep.reference;
  if (result.request.truth.value)
    return fmt::format("truth      {} is {:g}\n", judge(result)->name, *result.request.truth.value);
  if (!reference.failure.empty()) return fmt::format("no reference: {}\n", reference.failure);
  if (reference.name.empty()) return {};
  std::string text = fmt::format("reference  {}", reference.name);
  if (reference.is_estimated())
    text += fmt::format("; by the runs before it, it is off by up to {:.2g} m", reference.error.back());
  text += "\n";
  if (reference.holds < result.sweep.seconds)
    text += fmt::format(
        "           it holds for {:.3g} s of {:.3g} s: then finer steps end elsewhere, and there is no one answer; "
        "what "
        "still says something is energy, penetration, joint_error and the scene's checks\n",
        reference.holds, result.sweep.seconds);
  return text;
}

std::string order_lines(const AccuracyResult& result) {
  std::string text;
  for (const accuracy::Line& line : accuracy::lines_of(result.request, result.sweep))
    if (const auto order = accuracy::order_of_convergence(result.request, result.sweep, line, place_of_judge(result)))
      text += fmt::format("order      {}{}{:.2f} in {}\n", line.name, line.name.empty() ? "" : ": ", *order,
                          result.request.knobs.back().name);
  return text;
}

std::string bound_lines(const AccuracyResult& result) {
  if (!result.bound) return {};
  const std::size_t m = place_of_judge(result);
  std::string text;
  for (const accuracy::Line& line : accuracy::lines_of(result.request, result.sweep))
    if (const auto cost = accuracy::cost_at(result.request, result.sweep, line, m, *result.bound))
      text += fmt::format("at {:g}  {}{}{:.3g} ms ({:.3g} - {:.3g}){}\n", *result.bound, line.name,
                          line.name.empty() ? "" : ": ", cost->median, cost->low, cost->high,
                          cost->is_measured ? ", its cheapest" : ", between two settings");
  return text;
}

std::string times_own(const AccuracyResult& result, const Row& row) {
  if (!result.sweep.own || &result.sweep.rows[*result.sweep.own] == &row) return "";
  return fmt::format(", {:.2g} times the scene as it is",
                     row.ms.median / result.sweep.rows[*result.sweep.own].ms.median);
}

/// The one to take.
std::string advice_line(const AccuracyResult& result) {
  const double bound = result.bound.value_or(std::numeric_limits<double>::infinity());
  const auto best = accuracy::cheapest_within(result.request, result.sweep, place_of_judge(result), bound);
  const std::string what = result.bound ? fmt::format("{} of at most {:g}", judge(result)->name, *result.bound) : "";
  if (!best)
    return fmt::format("advice     none: no setting that was tried is sound{}\n", what.empty() ? "" : " with " + what);
  const Row& row = result.sweep.rows[*best];
  return fmt::format("advice     {}: the cheapest that is sound{}, {:.3g} ms for a second{}\n", row.label,
                     what.empty() ? "" : " with " + what, row.ms.median, times_own(result, row));
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

nlohmann::ordered_json vitals_json(const accuracy::Vitals& vitals) {
  return {{"deepest", vitals.deepest},
          {"deepest_share", vitals.deepest_share},
          {"joint_gap", vitals.joint_gap},
          {"energy_gained", vitals.most_gained},
          {"energy_lost", vitals.energy.lost()},
          {"energy_vanished", vitals.conserves ? vitals.vanished : 0},
          {"bodies_outside", vitals.outside},
          {"height_loss", vitals.height_loss},
          {"failed_checks", vitals.failed_checks}};
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

nlohmann::ordered_json lines_json(const AccuracyResult& result) {
  nlohmann::ordered_json lines = nlohmann::ordered_json::array();
  if (judge(result) == nullptr) return lines;
  for (const accuracy::Line& line : accuracy::lines_of(result.request, result.sweep)) {
    nlohmann::ordered_json entry{{"name", line.name}};
    if (const auto order = accuracy::order_of_convergence(result.request, result.sweep, line, place_of_judge(result)))
      entry["order"] = *order;
    if (result.bound)
      if (const auto cost =
              accuracy::cost_at(result.request, result.sweep, line, place_of_judge(result), *result.bound))
        entry["cost_at_bound"] = {{"median", cost->median}, {"low", cost->low}, {"high", cost->high}};
    lines.push_back(std::move(entry));
  }
  return lines;
}

nlohmann::ordered_json advice_json(const AccuracyResult& result) {
  if (judge(result) == nullptr) return nullptr;
  const double bound = result.bound.value_or(std::numeric_limits<double>::infinity());
  const auto best = accuracy::cheapest_within(result.request, result.sweep, place_of_judge(result), bound);
  return best ? nlohmann::ordered_json(result.sweep.rows[*best].label) : nlohmann::ordered_json(nullptr);
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
  if (judge(result) == nullptr) return {};
  return accuracy::front_of(result.request, result.sweep, place_of_judge(result));
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
  const bool with_error = judge(result) != nullptr && has_own_error(result);
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
    out += reference_lines(result) + order_lines(result) + bound_lines(result) + advice_line(result);
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
    out += fmt::format(",{},{},{},{},{}\n", judged ? judged_error(result, row) : NAN,
                       judged && !row.bands.empty() ? row.bands[place_of_judge(result)] : NAN,
                       on_front(result, i) ? 1 : 0, quoted(row.failure), quoted(row.unsound));
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
    if (judge(result) != nullptr && !row.series.empty()) {
      const accuracy::ErrorInterval error =
          accuracy::error_interval(result.request, result.sweep, i, place_of_judge(result));
      entry["error"] = {{"value", error.value}, {"low", error.low}, {"high", error.high}};
    }
    entry["vitals"] = vitals_json(row.vitals);
    if (!row.failure.empty()) entry["failure"] = row.failure;
    if (!row.unsound.empty()) entry["unsound"] = row.unsound;
    rows.push_back(std::move(entry));
  }
  const ordered_json document{{"format", 2},
                              {"scene", result.sweep.scene.name},
                              {"file", result.request.file},
                              {"broadphase", result.request.broadphase},
                              {"seconds", result.sweep.seconds},
                              {"settled_steps", result.request.settling ? result.request.settling->steps : 0},
                              {"repeats", result.request.repeats},
                              {"twin_spread", result.sweep.control_spread},
                              {"stopped", result.sweep.stopped},
                              {"machine", cpu_name()},
                              {"compiler", compiler_name()},
                              {"reference", reference_json(result)},
                              {"lines", lines_json(result)},
                              {"advice", advice_json(result)},
                              {"settings", rows}};
  return json_dump(document, 2) + "\n";
}

picture::Plot accuracy_plot(const AccuracyResult& result) {
  const std::string error = judge(result)->name;
  picture::Plot plot;
  plot.title = fmt::format("{}: {} against time", result.sweep.scene.name, error);
  plot.unit = error + (has_own_error(result) ? ", how far off" : ", worst of all steps");
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
    line.points.push_back({row.ms.median, failed ? 1 : worst, text_of(row.setting.back()), failed});
  }
  for (auto& [name, line] : lines) plot.lines.push_back(std::move(line));
  if (result.front.size() > 1) plot.lines.push_back(front_line(result));
  const auto level = [&](const std::string& name, double y, const picture::Colour& colour) {
    const auto [low, high] = std::minmax_element(result.sweep.rows.begin(), result.sweep.rows.end(),
                                                 [](const Row& a, const Row& b) { return a.ms.median < b.ms.median; });
    plot.lines.push_back({name, false, {{low->ms.median, y}, {high->ms.median, y}}, colour});
  };
  if (result.bound) level("bound", *result.bound, {0.2F, 0.55F, 0.3F});
  const double band =
      result.sweep.rows.front().bands.empty() ? NAN : result.sweep.rows.front().bands[place_of_judge(result)];
  if (band > 0) level("what the reference cannot tell", band, {0.8F, 0.6F, 0.3F});
  if (!positive) plot.y = picture::Axis::linear;
  return plot;
}

}  // namespace boxstream::tool
