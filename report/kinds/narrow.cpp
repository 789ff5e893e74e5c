// SPDX-License-Identifier: MIT
// Settings: `query` (distance, depth, verdict), `poses` in each panel, `passes` over them for each time that is taken;
// `panels`, each with `name`, `pair` (see PoseWish), `gap` [first, last], and if wanted `both_signs`, `scale`, and a
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

#include "accuracy/stopwatch.hpp"
#include "accuracy/turns.hpp"
#include "all.hpp"
#include "narrow/engine.hpp"
#include "narrow/in_child.hpp"
#include "narrow/score.hpp"
#include "understood.hpp"

namespace boxstream::report {
namespace {

using namespace narrow;
using nlohmann::json;

/// One series with one value of the knob.
struct Candidate {
  std::string series, engine_name;
  double value = NAN;
  Tuning tuning;
  PoseWish wish;
  std::vector<Pose> poses;
  std::unique_ptr<Engine> engine;
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

void turn(Candidate& candidate, const std::string& knob, double value) {
  if (knob == "tolerance")
    candidate.tuning.tolerance = value;
  else if (knob == "iterations")
    candidate.tuning.iterations = static_cast<int>(value);
  else if (knob == "margin")
    candidate.tuning.margin = value;
  else if (knob == "triangles")
    candidate.tuning.triangles = static_cast<int>(value);
  else if (knob == "gap")
    candidate.wish.first_gap = candidate.wish.last_gap = value;
  else if (knob == "scale")
    candidate.wish.scale = value;
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
      candidate.wish = {
          panel.at("pair").get<std::string>(), 0, 0, panel.value("both_signs", false), panel.value("scale", 1.0),
          settings.at("poses").get<int>()};
      if (panel.contains("gap")) {
        candidate.wish.first_gap = panel.at("gap").at(0).get<double>();
        candidate.wish.last_gap = panel.at("gap").at(1).get<double>();
      }
      for (const char* knob : {"tolerance", "iterations", "margin"})
        if (series.contains(knob)) turn(candidate, knob, series.at(knob).get<double>());
      candidate.value = value.get<double>();
      turn(candidate, settings.at("knob").get<std::string>(), candidate.value);
    }
  }
  return all;
}

void look(Candidate& candidate, Query query) {
  constexpr double seconds = 0.5;  // the slowest question takes a thousandth of it
  const auto answers =
      ask_in_child(candidate.poses.size(), seconds, [&](std::size_t i) { return candidate.engine->ask(i); });
  candidate.score = score(query, candidate.poses, answers);
  for (std::size_t i = 0; i < answers.size(); ++i)
    if (answers[i].how == Answer::How::answered) candidate.answered.push_back(i);
}

void ask_all(Candidate& candidate, int passes) {
  for (int pass = 0; pass < passes; ++pass)
    for (const std::size_t i : candidate.answered) candidate.engine->ask(i);
}

/// Microseconds for one question of those that were answered. In a child again: what FCL makes of a question can depend
/// on addresses, so one that it answered may end the process the next time.
double microseconds(Candidate& candidate, int passes) {
  const auto timed = [&](std::size_t) { return accuracy::stopwatch([&] { ask_all(candidate, passes); }); };
  const double per_question = 1e3 / passes / static_cast<double>(candidate.answered.size());
  // Callgrind counts for one process.
  if (!std::isnan(accuracy::counted_instructions())) return per_question * timed(0);
  constexpr double seconds = 60;
  const std::vector<Answer> answers = ask_in_child(1, seconds, [&](std::size_t i) {
    ask_all(candidate, 1);
    return timed(i);
  });
  if (answers[0].how != Answer::How::answered) {
    candidate.was_timed = false;
    candidate.score.failure = "what was answered once ended the process later";
  }
  return per_question * answers[0].value;
}

/// Of those that answer anything; the others have no cost.
accuracy::Turns take_turns(std::vector<Candidate>& candidates, int passes, int repeats) {
  std::vector<std::size_t> timed;
  for (std::size_t i = 0; i < candidates.size(); ++i)
    if (!candidates[i].answered.empty()) timed.push_back(i);
  accuracy::Estimate none;
  none.median = none.low = none.high = none.least = NAN;
  accuracy::Turns turns{std::vector(candidates.size(), none), 0};
  if (timed.empty()) return turns;
  const accuracy::Turns of_timed = accuracy::take_turns(
      timed.size(), repeats, [&](std::size_t i) { return microseconds(candidates[timed[i]], passes); });
  for (std::size_t i = 0; i < timed.size(); ++i)
    if (candidates[timed[i]].was_timed) turns.costs[timed[i]] = of_timed.costs[i];
  turns.twin_spread = of_timed.twin_spread;
  return turns;
}

Point point_of(const std::string& panel, const Candidate& candidate, const accuracy::Estimate& cost) {
  Point point;
  point.panel = panel;
  point.series = candidate.series;
  point.setting = fmt::format("{:g}", candidate.value);
  point.x = candidate.value;
  point.cost = cost;
  const Score& score = candidate.score;
  point.values = {score.error_max, score.error_p95, score.missed + score.extra,
                  score.missed,    score.extra,     score.unanswered};
  point.failure = candidate.score.failure;
  return point;
}

void measure_panel(const json& settings, const json& panel, int repeats, const Progress& progress, Results& results) {
  const Query query = query_of(panel.value("query", settings.at("query")).get<std::string>());
  const auto name = panel.at("name").get<std::string>();
  std::map<std::array<double, 3>, std::vector<Pose>> made;
  std::vector<Candidate> candidates = candidates_of(settings, panel);
  if (candidates.empty()) throw std::invalid_argument("no series is in panel \"" + name + "\"");
  for (Candidate& candidate : candidates) {
    progress(fmt::format("{}: {} {:g}", name, candidate.series, candidate.value));
    const PoseWish& wish = candidate.wish;
    std::vector<Pose>& poses = made[{wish.first_gap, wish.last_gap, wish.scale}];
    if (poses.empty()) poses = make_poses(wish);
    candidate.poses = poses;
    candidate.engine = make_engine(candidate.engine_name, query, candidate.tuning, candidate.poses);
    look(candidate, query);
  }
  progress(name + ": times");
  const accuracy::Turns turns = take_turns(candidates, settings.value("passes", 1), repeats);
  for (std::size_t i = 0; i < candidates.size(); ++i)
    results.points.push_back(point_of(name, candidates[i], turns.costs[i]));
  results.twins.push_back({name, turns.twin_spread});
}

}  // namespace

Results narrow_kind(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  Results results;
  results.cost_unit = "us per query";
  results.metrics = {"error_max", "error_p95", "wrong", "missed", "extra", "unanswered"};
  return with_settings_of(experiment, [&](const nlohmann::json&) {
    for (const json& panel : experiment.settings.at("panels"))
      measure_panel(experiment.settings, panel, options.repeats, progress, results);
    return results;
  });
}

}  // namespace boxstream::report
