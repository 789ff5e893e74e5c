// SPDX-License-Identifier: MIT
#include "boxstream/query/query_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/words.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "boxstream/simulate/summary.hpp"

namespace boxstream::tool {
namespace {

using query::ManagerRun;
using query::QueryScene;
using query::QueryStep;

using query::StepResult;
using Json = nlohmann::ordered_json;

Times times_of(const ManagerRun& run, std::size_t query, double QueryStep::*time) {
  std::vector<double> times;
  for (const StepResult& step : run.steps) times.push_back(step.queries[query].*time);
  return summarize(std::move(times));
}

Times update_times(const ManagerRun& run) {
  std::vector<double> times;
  for (const StepResult& step : run.steps) times.push_back(step.update_ms);
  return summarize(std::move(times));
}

/// One query over all steps.
struct Sums {
  std::uint64_t callbacks = 0, skipped = 0, failures = 0, pairs = 0, contacts = 0, touching = 0;
  double distance = std::numeric_limits<double>::infinity();
};

Sums sums_of(const ManagerRun& run, std::size_t query) {
  Sums sums;
  for (const StepResult& step : run.steps) {
    const QueryStep& q = step.queries[query];
    sums.callbacks += q.callbacks;
    sums.skipped += q.skipped;
    sums.failures += q.failures;
    sums.pairs += q.pairs;
    sums.contacts += q.contacts;
    sums.touching += q.touching ? 1 : 0;
    sums.distance = std::min(sums.distance, q.distance);
  }
  return sums;
}

/// Registering, all updates and all queries, without the narrow phase.
double broad_total(const ManagerRun& run, const QueryScene& scene) {
  double total = run.register_ms + update_times(run).total_ms;
  for (std::size_t q = 0; q < scene.queries.size(); ++q) total += times_of(run, q, &QueryStep::broad_ms).total_ms;
  return total;
}

double narrow_total(const ManagerRun& run, const QueryScene& scene) {
  double total = 0;
  for (std::size_t q = 0; q < scene.queries.size(); ++q) total += times_of(run, q, &QueryStep::narrow_ms).total_ms;
  return total;
}

std::string ms(double value) {
  return fmt::format("{:.{}f}", value, value < 10 ? 4 : value < 1000 ? 2 : 0);
}

std::string distance_text(const query::Query& query, const Sums& sums) {
  const bool measured = query.kind == query::Kind::distance || query.kind == query::Kind::within;
  return measured && std::isfinite(sums.distance) ? fmt::format("{:.6g}", sums.distance) : "-";
}

void print_manager(std::string& out, const QueryScene& scene, const ManagerRun& run) {
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{:<28}{:>12}{:>10}{:>10}{:>7}{:>12} |{:>10}{:>10}\n", run.manager, "callbacks", "pairs",
                 "contacts", "steps", "least", "broad", "narrow");
  fmt::format_to(to, "{:<28}{:>12}{:>10}{:>10}{:>7}{:>12} |{:>10}{:>10}\n", "", "a step", "a step", "a step", "hit",
                 "distance", "ms", "ms");
  const auto steps = static_cast<double>(run.steps.size());
  for (std::size_t q = 0; q < scene.queries.size(); ++q) {
    const Sums sums = sums_of(run, q);
    fmt::format_to(to, "{:<28}{:>12.1f}{:>10.2f}{:>10.2f}{:>7}{:>12} |{:>10}{:>10}\n", scene.queries[q].name,
                   static_cast<double>(sums.callbacks) / steps, static_cast<double>(sums.pairs) / steps,
                   static_cast<double>(sums.contacts) / steps, sums.touching, distance_text(scene.queries[q], sums),
                   ms(times_of(run, q, &QueryStep::broad_ms).median_ms),
                   ms(times_of(run, q, &QueryStep::narrow_ms).median_ms));
    if (sums.failures > 0)
      fmt::format_to(to, "{:<28}{} calls of FCL's narrow phase failed and count as touching\n", "",
                     grouped(sums.failures));
  }
  fmt::format_to(to, "{:<28}{:>63}\n", "update", "| " + fmt::format("{:>9}", ms(update_times(run).median_ms)));
  fmt::format_to(to, "{:<28}{:>63}\n\n", "register, once", "| " + fmt::format("{:>9}", ms(run.register_ms)));
}

const char* const kinds[] = {"collide", "first", "distance", "within"};

Json times_json(const Times& t) {
  return {{"median_ms", t.median_ms}, {"min_ms", t.min_ms}, {"total_ms", t.total_ms}};
}

Json finite(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json step_json(const StepResult& step, std::size_t number) {
  Json queries = Json::array();
  for (const QueryStep& q : step.queries)
    queries.push_back({{"callbacks", q.callbacks},
                       {"skipped", q.skipped},
                       {"failures", q.failures},
                       {"pairs", q.pairs},
                       {"contacts", q.contacts},
                       {"touching", q.touching},
                       {"distance", finite(q.distance)},
                       {"broad_ms", q.broad_ms},
                       {"narrow_ms", q.narrow_ms}});
  return {{"step", number}, {"update_ms", step.update_ms}, {"queries", std::move(queries)}};
}

Json manager_json(const QueryScene& scene, const ManagerRun& run) {
  Json queries = Json::array();
  for (std::size_t q = 0; q < scene.queries.size(); ++q) {
    const Sums sums = sums_of(run, q);
    queries.push_back({{"name", scene.queries[q].name},
                       {"kind", kinds[static_cast<std::size_t>(scene.queries[q].kind)]},
                       {"callbacks", sums.callbacks},
                       {"skipped", sums.skipped},
                       {"failures", sums.failures},
                       {"pairs", sums.pairs},
                       {"contacts", sums.contacts},
                       {"steps_touching", sums.touching},
                       {"least_distance", finite(sums.distance)},
                       {"broad", times_json(times_of(run, q, &QueryStep::broad_ms))},
                       {"narrow", times_json(times_of(run, q, &QueryStep::narrow_ms))}});
  }
  Json steps = Json::array();
  for (const StepResult& step : run.steps) steps.push_back(step_json(step, steps.size() + 1));
  return {{"manager", run.manager},
          {"register_ms", run.register_ms},
          {"update", times_json(update_times(run))},
          {"queries", std::move(queries)},
          {"steps", std::move(steps)}};
}

}  // namespace

std::string query_table(const query::QueryScene& scene, const query::RunResult& result) {
  std::string out;
  auto to = std::back_inserter(out);
  fmt::format_to(to, "{:<14}{}: {}\n{:<14}{}:", "scene", files::printable(scene.meta.name),
                 files::printable(scene.meta.about), "objects", grouped(result.objects));
  for (const query::GroupSize& group : result.groups)
    fmt::format_to(to, " {} {} ({} move)", files::printable(group.name), grouped(group.objects), grouped(group.moving));
  fmt::format_to(to, "\n{:<14}{}\n\n", "steps", result.managers[0].steps.size());
  for (const ManagerRun& run : result.managers) print_manager(out, scene, run);
  for (const ManagerRun& run : result.managers)
    fmt::format_to(to, "{:<14}{}: {} ms without the narrow phase, {} ms in it\n", "total", run.manager,
                   ms(broad_total(run, scene)), ms(narrow_total(run, scene)));
  if (!result.answers_equal) return out;
  const ManagerRun &a = result.managers[0], &b = result.managers[1];
  fmt::format_to(to, "{:<14}{:.2f}: above 1, {} takes less time without the narrow phase than {}\n", "ratio",
                 broad_total(b, scene) / broad_total(a, scene), a.manager, b.manager);
  if (*result.answers_equal)
    fmt::format_to(to, "{:<14}yes, of all queries in every step\n", "answers equal");
  else
    fmt::format_to(to, "{:<14}no: {}\n", "answers equal", result.first_difference);
  return out;
}

std::string query_json(const query::QueryScene& scene, const query::RunResult& result) {
  Json groups = Json::array();
  for (const query::GroupSize& group : result.groups)
    groups.push_back({{"name", group.name}, {"objects", group.objects}, {"moving", group.moving}});
  Json document = report_about({{"scene", scene.meta.name},
                                {"file", scene.file},
                                {"about", scene.meta.about},
                                {"steps", result.managers[0].steps.size()},
                                {"objects", result.objects},
                                {"groups", std::move(groups)},
                                {"fcl", query::fcl_version()}});
  if (result.answers_equal) {
    document["answers_equal"] = *result.answers_equal;
    if (!result.first_difference.empty()) document["first_difference"] = result.first_difference;
  }
  document["managers"] = Json::array();
  for (const ManagerRun& run : result.managers) document["managers"].push_back(manager_json(scene, run));
  return json_dump(document, 1) + "\n";
}

}  // namespace boxstream::tool
