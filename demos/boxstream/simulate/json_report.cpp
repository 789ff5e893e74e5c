// SPDX-License-Identifier: MIT
#include "boxstream/simulate/json_report.hpp"

#include <fmt/format.h>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>

#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"
#include "boxstream/simulate/reports.hpp"
#include "boxstream/simulate/simulate.hpp"
#include "boxstream/simulate/step_files.hpp"
#include "boxstream/simulate/summary.hpp"
#include "formats/scene_model/names.hpp"

namespace boxstream::tool {
namespace {

// Keeps the order in which keys are set: the document is also for reading.
using Json = nlohmann::ordered_json;

Json step_json(const scenes::Simulation& simulation, const scenes::StepResult& s) {
  const scenes::Scene& scene = simulation.scene();
  Json step{{"step", s.step},
            {"bodies", s.bodies},
            {"pairs", s.pairs},
            {"begun", s.begun},
            {"ended", s.ended},
            {"ghost_overlaps", s.ghost_overlaps},
            {"update_aabbs_ms", s.update_aabbs_ms},
            {"overlapping_pairs_ms", s.overlapping_pairs_ms},
            {"broadphase_ms", s.broadphase_ms},
            {"dispatch_ms", s.dispatch_ms},
            {"step_ms", s.step_ms},
            {"lost_ms", s.lost_ms},
            {"ray_hits", s.ray_hits},
            {"query_boxes", s.query_boxes},
            {"query_contacts", s.query_contacts},
            {"queries_ms", s.queries_ms},
            // JSON numbers are doubles to most readers, too narrow for 64 bits.
            {"state_hash", fmt::format("{:016x}", s.state_hash)}};
  if (!scene.sensors.empty()) {
    Json& events = step["sensor_events"] = Json::array();
    for (const effects::SensorEvent& event : s.sensor_events)
      events.push_back({{"sensor", scene.sensors[event.sensor].name},
                        {"object", event.object},
                        {"event", event.entered ? "enter" : "leave"},
                        {"name", object_name(simulation, event.object)}});
  }
  return step;
}

Json world_json(const WorldRun& world) {
  Json summary;
  for (const Phase& phase : phases()) {
    const Times t = summarize(times_ms(world.steps, phase));
    summary[phase.json_name] = {{"median_ms", t.median_ms}, {"min_ms", t.min_ms}, {"total_ms", t.total_ms}};
  }
  Json steps = Json::array();
  for (const scenes::StepResult& s : world.steps) steps.push_back(step_json(*world.simulation, s));
  Json on = Json::array();
  for (const effects::Effect* const effect : world.simulation->effects_on()) on.push_back(effect->name);
  Json late = Json::array();
  for (const effects::SwitchedOn& one : world.simulation->switched_on())
    late.push_back({{"effect", one.effect->name}, {"step", one.step}, {"reason", one.reason}});
  Json activity = Json::array();
  for (const scenes::EffectActivity& each : world.simulation->activity())
    activity.push_back({{"effect", each.effect->name}, {"count", each.count}, {"unit", each.effect->activity.unit}});
  Json checks = Json::array();
  for (const scenes::CheckResult& result : world.simulation->check_results())
    checks.push_back({{"check", check_text(world.simulation->scene().checks[result.check])},
                      {"asked", result.asked},
                      {"passed", result.passed},
                      {"step", result.step},
                      {"value", result.value}});
  const scenes::EnergyBalance balance = world.simulation->energy_balance();
  Json energy{{"start_j", balance.first}, {"end_j", balance.now}, {"lost_j", balance.lost()}};
  for (const auto& [name, joules] : parts_of(balance.work)) energy["work_j"][name] = joules;
  energy["steps_that_gained"] = balance.gains;
  if (balance.worst)
    energy["worst_gain"] = {{"step", balance.worst->step},
                            {"j", balance.worst->energy},
                            {"share", balance.worst->share},
                            {"body", balance.worst->body}};
  return {{"broadphase", world.broadphase},  {"clock", measure::clock_name(world.simulation->clock())},
          {"effects", std::move(on)},        {"switched_on", std::move(late)},
          {"activity", std::move(activity)}, {"energy", std::move(energy)},
          {"vitals", vitals_json(world)},    {"checks", std::move(checks)},
          {"summary", std::move(summary)},   {"steps", std::move(steps)}};
}

}  // namespace

std::string result_json(const scenes::Scene& scene, const RunResult& result) {
  const scenes::Census census = result.worlds.front().simulation->census();
  Json document =
      report_about({{"scene", scene.meta.name},
                    {"file", scene.file},
                    {"about", scene.meta.about},
                    {"dt", scene.time.dt},
                    {"steps", result.worlds.front().steps.size()},
                    {"precision", scenes::precision_names().at(static_cast<std::size_t>(scene.solver.precision))},
                    {"objects", census.objects},
                    {"dynamic", census.dynamic},
                    {"bullet", bullet_version()}});
  if (result.pairs_equal) {
    document["pairs_equal"] = *result.pairs_equal;
    if (!result.first_difference.empty()) document["first_difference"] = result.first_difference;
  }
  document["worlds"] = Json::array();
  for (const WorldRun& world : result.worlds) document["worlds"].push_back(world_json(world));
  return json_dump(document, 1) + "\n";
}

nlohmann::json document_of(const scenes::Scene& scene, const std::string& broadphase) {
  StatusLine quiet;
  const RunResult result = run(scene, broadphase, std::nullopt, static_cast<std::uint64_t>(scene.time.steps), quiet);
  return nlohmann::json::parse(result_json(scene, result));
}

}  // namespace boxstream::tool
