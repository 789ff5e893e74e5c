// SPDX-License-Identifier: MIT
#include "boxstream/accuracy/accuracy_json.hpp"

#include <algorithm>
#include <cmath>

#include "boxstream/shared/json_dump.hpp"
#include "boxstream/shared/machine.hpp"

namespace boxstream::tool {
namespace {

using accuracy::Row;
using accuracy::Series;

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

}  // namespace

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

}  // namespace boxstream::tool
