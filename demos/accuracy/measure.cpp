// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/words.hpp"
#include "knob.hpp"
#include "measure/interleave.hpp"
#include "measure/stopwatch.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Check;
using Kind = Measure::Kind;

/// A quantity of ours, beside the metrics of scenes.
struct Quantity {
  std::string name;
  Kind kind;
  std::string needs;
  Better better = Better::low;
  bool needs_reference = false;
};

const std::string bodies = "dynamic bodies", named_body = "--body",
                  expected = "an expected velocity, which only experiments of the report have";

const Quantity own[] = {
    {"momentum_drift", Kind::momentum_drift, "a momentum at the start"},
    {"angular_momentum_drift", Kind::angular_momentum_drift, "an angular momentum at the start"},
    {"energy_change", Kind::energy_change, "", Better::near_zero},
    {"joint_error", Kind::joint_error, "joints"},
    {"joint_angle", Kind::joint_angle, "joints"},
    {"mean_square_penetration", Kind::mean_square_penetration, ""},
    {"height_loss", Kind::height_loss, bodies},
    {"tunnelled", Kind::tunnelled, bodies},
    {"collapse_time", Kind::collapse_time, "", Better::high},
    {"stands", Kind::stands, "", Better::high},
    {"trajectory", Kind::trajectory, bodies, Better::low, true},
    {"orientation", Kind::orientation, bodies, Better::low, true},
    {"agrees_for", Kind::agrees_for, "", Better::high, true},
    {"trajectory_until", Kind::trajectory_until, "contacts that agree with the reference's for a step", Better::low,
     true},
    {"velocity_error", Kind::velocity_error, expected},
    {"direction_error", Kind::direction_error, expected},
    {"x", Kind::body_x, named_body, Better::as_reference},
    {"y", Kind::body_y, named_body, Better::as_reference},
    {"z", Kind::body_z, named_body, Better::as_reference},
    {"speed", Kind::body_speed, named_body, Better::as_reference},
    {"spin", Kind::body_spin, named_body, Better::as_reference},
    {"/", Kind::field, "such a number in the JSON of boxstream simulate", Better::as_reference},
    {"truth", Kind::truth, "--truth FILE.csv and --body"},
    {"repeatable", Kind::repeatable, "", Better::high},
};

/// None for a metric of scenes.
const Quantity* quantity_of(const Measure& measure) {
  const auto found =
      std::find_if(std::begin(own), std::end(own), [&](const Quantity& q) { return q.kind == measure.kind; });
  return found == std::end(own) ? nullptr : found;
}

const std::array<std::string, 5> statistics{"worst", "p95", "mean", "last", "integral"};

/// With its sign.
double furthest_from_zero(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
}

}  // namespace

double timed(scenes::Scene scene, const std::string& broadphase, std::uint64_t steps) {
  const auto clock = scene.broadphase.threads > 1 ? measure::Clock::wall : measure::Clock::cpu;
  const double seconds = static_cast<double>(steps) * scene.time.dt;
  scene.checks.clear();
  scenes::Simulation simulation(scene, broadphase);
  const auto run = [&] {
    for (std::uint64_t step = 0; step < steps; ++step) simulation.advance();
  };
  return measure::time_once(run, clock) / seconds;
}

std::vector<std::string> measure_names() {
  std::vector<std::string> names = scenes::metric_names();
  names.insert(names.begin(), "penetration");
  for (const Quantity& quantity : own)
    if (quantity.kind != Kind::field) names.push_back(quantity.name);
  return names;
}

Measure parse_measure(const std::string& name) {
  Measure measure;
  measure.name = name;
  if (name.starts_with('/')) {
    measure.kind = Kind::field;
    try {
      (void)nlohmann::json::json_pointer(name);
    } catch (const nlohmann::json::exception&) {
      throw BadKnob(name + ": no JSON pointer");
    }
    return measure;
  }
  std::string quantity = name.substr(0, name.find('.'));
  if (quantity != name) {
    const std::string word = name.substr(quantity.size() + 1);
    const auto found = std::find(statistics.begin(), statistics.end(), word);
    if (found == statistics.end())
      throw BadKnob(name + ": " + unknown_word("statistic", word, {statistics.begin(), statistics.end()}));
    measure.statistic = static_cast<Measure::Statistic>(found - statistics.begin());
  }
  if (quantity == "penetration") quantity = "max_penetration";
  const std::vector<std::string>& metrics = scenes::metric_names();
  if (const auto found = std::find(metrics.begin(), metrics.end(), quantity); found != metrics.end()) {
    measure.metric = static_cast<Check::Metric>(found - metrics.begin());
    return measure;
  }
  for (const Quantity& other : own) {
    if (other.name != quantity) continue;
    measure.kind = other.kind;
    return measure;
  }
  throw BadKnob(unknown_word("metric", quantity, measure_names()));
}

bool needs_reference(const Measure& measure) {
  const Quantity* const quantity = quantity_of(measure);
  return quantity != nullptr && quantity->needs_reference;
}

bool is_of_body(const Measure& measure) {
  return measure.kind >= Kind::body_x && measure.kind <= Kind::body_spin;
}

Better better(const Measure& measure) {
  if (const Quantity* const quantity = quantity_of(measure)) return quantity->better;
  switch (measure.metric) {
    case Check::Metric::finite:
      return Better::high;
    case Check::Metric::missed_pairs:
    case Check::Metric::outside:
    case Check::Metric::max_penetration:
    case Check::Metric::energy_drift:
    case Check::Metric::residual:
      return Better::low;
    default:
      return Better::as_reference;
  }
}

std::string needs(const Measure& measure) {
  const Quantity* const quantity = quantity_of(measure);
  return quantity == nullptr ? "" : quantity->needs;
}

Series summed_up(const Measure& measure, const std::vector<double>& values, double seconds) {
  Series series;
  if (std::any_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }))
    return {NAN, NAN, NAN, NAN, NAN};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const bool smallest =
      better(measure) == Better::high || (measure.kind == Kind::metric && measure.metric == Check::Metric::lowest);
  series.worst = smallest ? *least : *most;
  if (better(measure) == Better::near_zero) series.worst = furthest_from_zero(values);
  series.p95 = measure::quantile(values, smallest ? 0.05 : 0.95);
  for (const double value : values) series.mean += value / static_cast<double>(values.size());
  series.last = values.back();
  series.integral = series.mean * seconds;
  return series;
}

}  // namespace boxstream::accuracy
