// SPDX-License-Identifier: MIT
// Settings: `query` (distance, depth, verdict), `poses` in each panel, `passes` over them for each time that is taken;
// `panels`, each with `name`, `pair` (see PoseRequest), `gap` [first, last], and if wanted `both_signs`, `scale`, and a
// `query` of its own; `knob` (tolerance, iterations, margin, triangles, gap, scale) with its `values`; `series`, by
// name, each with `engine` (see make_engine), other knobs that it has fixed, `values` of its own, and the only `panels`
// that it is in.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <stdexcept>

#include "experiment_kinds/kinds.hpp"
#include "narrow_phase/engine.hpp"
#include "narrow_phase/in_child.hpp"
#include "narrow_phase/score.hpp"

namespace boxstream::report {
namespace {

using namespace narrow;
using nlohmann::json;

/// One series with one value of the knob.
struct Candidate {
  std::string series, engine_name;
  double value = NAN;
  Tuning tuning;
  PoseRequest request;
  std::vector<Pose> poses;
  Engine engine;
  std::vector<std::size_t> answered;
  bool was_timed = true;
  Score score;
};

Query query_of(const std::string& name) {
  if (name == "distance") return Query::distance;
  if (name == "depth") return Query::depth;
  if (name == "verdict") return Query::verdict;
  throw std::invalid_argument("no query \"" + name + "\"; there are distance, depth, verdict");
}

void set(Candidate& candidate, const std::string& knob, double value) {
  if (knob == "tolerance")
    candidate.tuning.tolerance = value;
  else if (knob == "iterations")
    candidate.tuning.iterations = static_cast<int>(value);
  else if (knob == "margin")
    candidate.tuning.margin = value;
  else if (knob == "triangles")
    candidate.tuning.triangles = static_cast<int>(value);
  else if (knob == "gap")
    candidate.request.first_gap = candidate.request.last_gap = value;
  else if (knob == "scale")
    candidate.request.scale = value;
  else
    throw std::invalid_argument("no knob \"" + knob +
                                "\"; there are tolerance, iterations, margin, triangles, gap, scale");
}

std::vector<Candidate> candidates_of(const json& settings, const json& panel) {
  std::vector<Candidate> all;
  for (const auto& [name, series] : settings.at("series").items()) {
    const json no_panels = json::array();
    const json& only = series.contains("panels") ? series.at("panels") : no_panels;
    if (!only.empty() && std::find(only.begin(), only.end(), panel.at("name")) == only.end()) continue;
    for (const json& value : series.value("values", settings.at("values"))) {
      Candidate& candidate = all.emplace_back();
      candidate.series = name;
      candidate.engine_name = series.at("engine").get<std::string>();
      candidate.request = {
          panel.at("pair").get<std::string>(), 0, 0, panel.value("both_signs", false), panel.value("scale", 1.0),
          settings.at("poses").get<int>()};
      if (panel.contains("gap")) {
        candidate.request.first_gap = panel.at("gap").at(0).get<double>();
        candidate.request.last_gap = panel.at("gap").at(1).get<double>();
      }
      for (const char* knob : {"tolerance", "iterations", "margin"})
        if (series.contains(knob)) set(candidate, knob, series.at(knob).get<double>());
      candidate.value = value.get<double>();
      set(candidate, settings.at("knob").get<std::string>(), candidate.value);
    }
  }
  return all;
}

void check(Candidate& candidate, Query query) {
  constexpr double seconds = 0.5;  // the slowest query takes a thousandth of it
  const auto answers =
      ask_in_child(candidate.poses.size(), seconds, [&](std::size_t i) { return candidate.engine(i); });
  candidate.score = score(query, candidate.poses, answers);
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i].how == Answer::How::answered) candidate.answered.push_back(i);
}

void ask_all(Candidate& candidate, int passes) {
  for (int pass = 0; pass < passes; ++pass)
    for (const std::size_t i : candidate.answered) candidate.engine(i);
}

/// Microseconds per query, of those that were answered. In a child again: FCL's result can depend on
/// addresses, so a query that succeeded once may end the process the next time.
double microseconds(Candidate& candidate, int passes) {
  const auto timed = [&](std::size_t) { return measure::time_once([&] { ask_all(candidate, passes); }); };
  const double per_query = 1e3 / passes / static_cast<double>(candidate.answered.size());
  // Callgrind counts for one process.
  if (!std::isnan(measure::counted_instructions())) return per_query * timed(0);
  constexpr double seconds = 60;
  const std::vector<Answer> answers = ask_in_child(1, seconds, [&](std::size_t i) {
    ask_all(candidate, 1);
    return timed(i);
  });
  if (answers[0].how != Answer::How::answered) {
    candidate.was_timed = false;
    candidate.score.failure = "what was answered once ended the process later";
  }
  return per_query * answers[0].value;
}

/// Only of candidates that answer something; the others have no cost.
measure::Costs costs_of(std::vector<Candidate>& candidates, int passes, int repeats) {
  std::vector<std::size_t> timed;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (!candidates[i].answered.empty()) timed.push_back(i);
  measure::Costs costs{std::vector(candidates.size(), measure::Estimate{NAN, NAN, NAN, NAN, NAN}), 0};
  if (timed.empty()) return costs;
  const measure::Costs of_timed = measure::interleave_with_control(
      timed.size(), repeats, [&](std::size_t i) { return microseconds(candidates[timed[i]], passes); });
  for (std::size_t i = 0; i < timed.size(); ++i)
    if (candidates[timed[i]].was_timed) costs.of[timed[i]] = of_timed.of[i];
  costs.control_spread = of_timed.control_spread;
  return costs;
}

void measure_panel(const json& settings, const json& panel, Measurement& measurement) {
  const Query query = query_of(panel.value("query", settings.at("query")).get<std::string>());
  const auto name = panel.at("name").get<std::string>();
  std::map<std::array<double, 3>, std::vector<Pose>> made;
  std::vector<Candidate> candidates = candidates_of(settings, panel);
  if (candidates.empty()) throw std::invalid_argument("no series is in panel \"" + name + "\"");
  for (Candidate& candidate : candidates) {
    measurement.progress(fmt::format("{}: {} {:g}", name, candidate.series, candidate.value));
    const PoseRequest& request = candidate.request;
    std::vector<Pose>& poses = made[{request.first_gap, request.last_gap, request.scale}];
    if (poses.empty()) poses = make_poses(request);
    candidate.poses = poses;
    candidate.engine = make_engine(candidate.engine_name, query, candidate.tuning, candidate.poses);
    check(candidate, query);
  }
  measurement.progress(name + ": times");
  const measure::Costs costs = costs_of(candidates, settings.value("passes", 1), measurement.repeats);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const Candidate& candidate = candidates[i];
    const Score& score = candidate.score;
    measurement.results.points.push_back({.panel = name,
                                          .series = candidate.series,
                                          .setting = fmt::format("{:g}", candidate.value),
                                          .x = candidate.value,
                                          .cost = costs.of[i],
                                          .values = {score.error_max, score.error_p95, score.missed + score.extra,
                                                     score.missed, score.extra, score.unanswered},
                                          .failure = score.failure});
  }
  measurement.results.controls.push_back({name, costs.control_spread});
}

}  // namespace

void measure_narrow_phases(Measurement& measurement) {
  const json& settings = measurement.settings();
  for (const json& panel : settings.at("panels")) measure_panel(settings, panel, measurement);
}

}  // namespace boxstream::report
