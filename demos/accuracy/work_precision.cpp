// SPDX-License-Identifier: MIT
#include "work_precision.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

namespace boxstream::accuracy {
namespace {

double band_of(const Row& row, std::size_t measure) {
  return measure < row.bands.size() && std::isfinite(row.bands[measure]) ? row.bands[measure] : 0;
}

/// The size of a step that a value of a knob stands for, as far as order is concerned. None for knobs without one.
std::optional<double> step_of(const Knob& knob, const nlohmann::json& value) {
  if (!value.is_number() || !(value.get<double>() > 0)) return std::nullopt;
  if (knob.pointer == "/time/dt") return value.get<double>();
  if (knob.pointer == "/time/substeps" || knob.pointer == "/solver/iterations") return 1 / value.get<double>();
  return std::nullopt;
}

double logarithm(double x) {
  return std::log(std::max(x, 1e-300));
}

/// Where a straight line between two points on logarithmic axes has the height `bound`.
double between(double cost_above, double above, double cost_below, double below, double bound) {
  const double width = logarithm(above) - logarithm(below);
  if (!(width > 0)) return cost_below;
  const double part = std::clamp((logarithm(above) - logarithm(bound)) / width, 0.0, 1.0);
  return std::exp(logarithm(cost_above) + part * (logarithm(cost_below) - logarithm(cost_above)));
}

bool is_usable(const Request& request, const Sweep& sweep, std::size_t row, std::size_t measure) {
  return sweep.rows[row].may_be_advised() && std::isfinite(error_of(request, sweep, sweep.rows[row], measure));
}

/// Values other than those of the scene itself.
int changes(const Sweep& sweep, std::size_t row) {
  int count = 0;
  for (std::size_t k = 0; k < sweep.rows[row].setting.size(); ++k)
    count += sweep.rows[row].setting[k] != sweep.rows[*sweep.own].setting[k];
  return count;
}

}  // namespace

ErrorInterval error_interval(const Request& request, const Sweep& sweep, std::size_t row, std::size_t measure) {
  const double error = error_of(request, sweep, sweep.rows[row], measure), band = band_of(sweep.rows[row], measure);
  return {std::max(0.0, error - band), error, error + band};
}

std::vector<Line> lines_of(const Request& request, const Sweep& sweep) {
  std::vector<Line> lines;
  for (std::size_t i = 0; i < sweep.rows.size(); ++i) {
    const Setting& setting = sweep.rows[i].setting;
    const Setting others(setting.begin(), setting.end() - (setting.empty() ? 0 : 1));
    const std::string name = label(request.knobs, others);
    auto line = std::find_if(lines.begin(), lines.end(), [&](const Line& each) { return each.name == name; });
    if (line == lines.end()) line = lines.insert(line, Line{name, {}});
    line->rows.push_back(i);
  }
  return lines;
}

std::optional<double> order_of_convergence(const Request& request, const Sweep& sweep, const Line& line,
                                           std::size_t measure) {
  std::vector<std::pair<double, double>> points;  // logarithms of step and error
  for (const std::size_t i : line.rows) {
    const Row& row = sweep.rows[i];
    const auto step = step_of(request.knobs.back(), row.setting.back());
    const double error = error_of(request, sweep, row, measure);
    if (!step || !is_usable(request, sweep, i, measure) || !(error > 2 * band_of(row, measure)) || !(error > 0))
      continue;
    points.emplace_back(std::log(*step), std::log(error));
  }
  if (points.size() < 3) return std::nullopt;
  double x = 0, y = 0, xx = 0, xy = 0;
  const auto n = static_cast<double>(points.size());
  for (const auto& [step, error] : points) x += step / n, y += error / n;
  for (const auto& [step, error] : points) xx += (step - x) * (step - x), xy += (step - x) * (error - y);
  const double slope = xy / xx;
  return slope > 0.05 ? std::optional<double>(slope) : std::nullopt;
}

std::optional<CostAt> cost_at(const Request& request, const Sweep& sweep, const Line& line, std::size_t measure,
                              double bound) {
  std::vector<std::size_t> rows;
  for (const std::size_t i : line.rows)
    if (is_usable(request, sweep, i, measure)) rows.push_back(i);
  std::sort(rows.begin(), rows.end(),
            [&](std::size_t a, std::size_t b) { return sweep.rows[a].ms.median < sweep.rows[b].ms.median; });
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const Row& row = sweep.rows[rows[k]];
    const ErrorInterval error = error_interval(request, sweep, rows[k], measure);
    if (!(error.value <= bound)) continue;
    if (k == 0) return CostAt{row.ms.median, row.ms.low, row.ms.high, true};
    const Row& cheaper = sweep.rows[rows[k - 1]];
    const ErrorInterval worse = error_interval(request, sweep, rows[k - 1], measure);
    const auto cost = [&](double cost_above, double above, double cost_below, double below) {
      return between(cost_above, above, cost_below, below, bound);
    };
    return CostAt{cost(cheaper.ms.median, worse.value, row.ms.median, error.value),
                  cost(cheaper.ms.low, worse.low, row.ms.low, std::min(error.low, bound)),
                  cost(cheaper.ms.high, worse.high, row.ms.high, std::min(error.high, bound)), false};
  }
  return std::nullopt;
}

std::vector<std::size_t> front_of(const Request& request, const Sweep& sweep, std::size_t measure) {
  std::vector<Offer> offers;
  for (std::size_t i = 0; i < sweep.rows.size(); ++i) {
    const Row& row = sweep.rows[i];
    const double error = is_usable(request, sweep, i, measure) ? error_of(request, sweep, row, measure) : std::nan("");
    // What the reference cannot tell from it is right.
    offers.push_back({row.ms.median, better(request.measures[measure]) == Better::high
                                         ? error
                                         : std::max(error, band_of(row, measure))});
  }
  std::vector<std::size_t> best = front(offers);
  // What is as good, and as cheap as far as the clock can tell, is beaten by chance alone.
  for (std::size_t i = 0; i < offers.size(); ++i) {
    const bool is_level = std::any_of(best.begin(), best.end(), [&](std::size_t k) {
      return offers[k].error == offers[i].error && sweep.rows[i].ms.low <= sweep.rows[k].ms.high;
    });
    if (is_level && std::find(best.begin(), best.end(), i) == best.end()) best.push_back(i);
  }
  std::sort(best.begin(), best.end(), [&](std::size_t a, std::size_t b) { return offers[a].cost < offers[b].cost; });
  return best;
}

std::optional<std::size_t> cheapest_within(const Request& request, const Sweep& sweep, std::size_t measure,
                                           double bound) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < sweep.rows.size(); ++i) {
    if (!is_usable(request, sweep, i, measure) || !(error_of(request, sweep, sweep.rows[i], measure) <= bound))
      continue;
    if (!best || sweep.rows[i].ms.median < sweep.rows[*best].ms.median) best = i;
  }
  // Among those that cost the same, the one that changes least.
  for (std::size_t i = 0; best && sweep.own && i < sweep.rows.size(); ++i) {
    const Row& row = sweep.rows[i];
    const bool same = row.ms.low <= sweep.rows[*best].ms.high && is_usable(request, sweep, i, measure) &&
                      error_of(request, sweep, row, measure) <= bound;
    if (same && changes(sweep, i) < changes(sweep, *best)) best = i;
  }
  return best;
}

double parse_bound(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  std::string_view unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  while (!unit.empty() && unit.front() == ' ') unit.remove_prefix(1);
  constexpr std::pair<std::string_view, double> units[] = {{"", 1},      {"m", 1},    {"cm", 0.01}, {"mm", 0.001},
                                                           {"um", 1e-6}, {"%", 0.01}, {"deg", 1},   {"s", 1},
                                                           {"J", 1},     {"m/s", 1}};
  const auto* const found =
      std::find_if(std::begin(units), std::end(units), [&](const auto& u) { return u.first == unit; });
  if (error != std::errc() || found == std::end(units) || !(value > 0) || !std::isfinite(value))
    throw BadKnob("--bound " + text +
                  ": a bound is a number above 0, with m, cm, mm, um, %, deg, s, J, m/s or nothing behind it");
  return value * found->second;
}

}  // namespace boxstream::accuracy
