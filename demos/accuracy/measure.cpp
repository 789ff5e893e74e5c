// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "knob.hpp"
#include "statistics.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Check;
using Kind = Measure::Kind;

/// In the order of Kind, from the one after `metric`.
const std::vector<std::string>& own_names() {
  static const std::vector<std::string> names{"momentum_drift", "angular_momentum_drift",
                                              "energy_change",  "joint_error",
                                              "joint_angle",    "mean_square_penetration",
                                              "height_loss",    "tunnelled",
                                              "collapse_time",  "stands",
                                              "trajectory",     "orientation",
                                              "agrees_for",     "trajectory_until",
                                              "velocity_error", "direction_error",
                                              "repeatable"};
  return names;
}

const std::array<std::string, 5> statistics{"worst", "p95", "mean", "last", "integral"};

bool smallest_is_worst(const Measure& measure) {
  switch (measure.kind) {
    case Kind::metric:
      return measure.metric == Check::Metric::lowest || measure.metric == Check::Metric::finite;
    case Kind::collapse_time:
    case Kind::stands:
    case Kind::agrees_for:
    case Kind::repeatable:
      return true;
    default:
      return false;
  }
}

/// With its sign.
double furthest_from_zero(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
}

}  // namespace

const std::vector<std::string>& measure_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = scenes::metric_names();
    all.insert(all.end(), own_names().begin(), own_names().end());
    return all;
  }();
  return names;
}

Measure parse_measure(const std::string& name) {
  Measure measure;
  measure.name = name;
  std::string quantity = name.substr(0, name.find('.'));
  if (quantity != name) {
    const std::string word = name.substr(quantity.size() + 1);
    const auto found = std::find(statistics.begin(), statistics.end(), word);
    if (found == statistics.end())
      throw BadKnob(name + ": after the dot there is one of worst, p95, mean, last, integral");
    measure.statistic = static_cast<Measure::Statistic>(found - statistics.begin());
  }
  if (quantity == "penetration") quantity = "max_penetration";
  const std::vector<std::string>& metrics = scenes::metric_names();
  if (const auto found = std::find(metrics.begin(), metrics.end(), quantity); found != metrics.end()) {
    measure.metric = static_cast<Check::Metric>(found - metrics.begin());
    return measure;
  }
  const auto found = std::find(own_names().begin(), own_names().end(), quantity);
  if (found == own_names().end()) {
    std::string known = "penetration";
    for (const std::string& other : measure_names()) known += ", " + other;
    throw BadKnob(name + ": no metric of this name; there are " + known);
  }
  measure.kind = static_cast<Kind>(1 + (found - own_names().begin()));
  return measure;
}

bool needs_reference(const Measure& measure) {
  return measure.kind == Kind::trajectory || measure.kind == Kind::orientation || measure.kind == Kind::agrees_for ||
         measure.kind == Kind::trajectory_until;
}

double Series::of(const Measure& measure) const {
  switch (measure.statistic) {
    case Measure::Statistic::worst:
      return worst;
    case Measure::Statistic::p95:
      return p95;
    case Measure::Statistic::mean:
      return mean;
    case Measure::Statistic::last:
      return last;
    case Measure::Statistic::integral:
      return integral;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

Series summed_up(const Measure& measure, const std::vector<double>& values, double seconds) {
  Series series;
  if (std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); })) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan, nan, nan, nan};
  }
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const bool smallest = smallest_is_worst(measure);
  series.worst = smallest ? *least : *most;
  if (measure.kind == Kind::energy_change) series.worst = furthest_from_zero(values);
  series.p95 = quantile(values, smallest ? 0.05 : 0.95);
  for (const double value : values) series.mean += value / static_cast<double>(values.size());
  series.last = values.back();
  series.integral = series.mean * seconds;
  return series;
}

}  // namespace boxstream::accuracy
