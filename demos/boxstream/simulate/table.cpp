// SPDX-License-Identifier: MIT

#include <fmt/format.h>

#include <iterator>
#include <utility>

#include "base/words.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/simulate/reports.hpp"
#include "boxstream/simulate/summary.hpp"

namespace boxstream::tool {
namespace {

std::string milliseconds(double ms) {
  return fmt::format("{:.{}f}", ms, ms < 10 ? 3 : ms < 1000 ? 2 : 0);
}

std::string quotient(double a, double b) {
  return b > 0 ? fmt::format("{:.2f}", a / b) : "-";
}

std::string census_text(const scenes::Census& c) {
  std::string text = fmt::format("{}", grouped(c.objects));
  std::string parts;
  for (const auto& [count, name] : {std::pair{c.dynamic, "dynamic"},
                                    {c.fixed, "fixed"},
                                    {c.kinematic, "kinematic"},
                                    {c.sensors, "sensors"},
                                    {c.characters, "characters"},
                                    {c.soft_bodies, "soft"}})
    if (count > 0) parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", grouped(count), name);
  if (!parts.empty()) text += " (" + parts + ")";
  if (c.joints > 0) text += fmt::format(", {} joints", grouped(c.joints));
  return text;
}

std::string effects_text(const scenes::Simulation& simulation) {
  std::string names;
  const std::vector<const effects::Effect*> on = simulation.effects_on();
  for (const effects::Effect* const effect : on) names += (names.empty() ? "" : ", ") + std::string(effect->name);
  const std::size_t all = simulation.plan().size();
  return on.size() == all ? fmt::format("all {}", all) : fmt::format("{} of {}: {}", on.size(), all, names);
}

/// What effects did, and which did nothing though they were on.
std::string activity_text(const scenes::Simulation& simulation) {
  std::string acted, idle;
  for (const scenes::EffectActivity& each : simulation.activity()) {
    if (each.count == 0)
      idle += (idle.empty() ? "" : ", ") + std::string(each.effect->name);
    else
      acted += fmt::format("{:<14}{:<22}{:>14} {}\n", acted.empty() ? "acted" : "", each.effect->name,
                           grouped(each.count), each.effect->activity.unit);
  }
  return acted + (idle.empty() ? "" : fmt::format("{:<14}{}\n", "never acted", idle));
}

const char* clock_text(measure::Clock clock) {
  return clock == measure::Clock::cpu ? "processor time of one thread" : "elapsed time, since threads share the work";
}

void print_times(std::string& out, const RunResult& result) {
  auto to = std::back_inserter(out);
  if (!result.is_comparison()) {
    fmt::format_to(to, "{:<14}{:>12}{:>12}{:>12}\n", "ms", "median", "min", "total");
    for (const Phase& phase : phases()) {
      const Times t = summarize(times_ms(result.worlds[0].steps, phase));
      fmt::format_to(to, "{:<14}{:>12}{:>12}{:>12}\n", phase.name, milliseconds(t.median_ms), milliseconds(t.min_ms),
                     milliseconds(t.total_ms));
    }
    return;
  }
  const std::string& a = result.worlds[0].broadphase;
  const std::string& b = result.worlds[1].broadphase;
  fmt::format_to(to, "{:<12}{:>33}{:>38}\n", "", "median ms per step", "total ms");
  fmt::format_to(to, "{:<12}{:>13}{:>13}{:>7}   {:>13}{:>13}{:>7}\n", "", a, b, "ratio", a, b, "ratio");
  for (const Phase& phase : phases()) {
    const Times x = summarize(times_ms(result.worlds[0].steps, phase));
    const Times y = summarize(times_ms(result.worlds[1].steps, phase));
    fmt::format_to(to, "{:<12}{:>13}{:>13}{:>7}   {:>13}{:>13}{:>7}\n", phase.name, milliseconds(x.median_ms),
                   milliseconds(y.median_ms), quotient(y.median_ms, x.median_ms), milliseconds(x.total_ms),
                   milliseconds(y.total_ms), quotient(y.total_ms, x.total_ms));
  }
  fmt::format_to(to, "{:<12}{} / {}: above 1, {} takes less time\n", "ratio", b, a, a);
}

void print_pairs(std::string& out, const RunResult& result) {
  auto to = std::back_inserter(out);
  for (const WorldRun& world : result.worlds) {
    std::uint64_t begun = 0;
    std::uint64_t ended = 0;
    for (const scenes::StepResult& s : world.steps) {
      begun += s.begun;
      ended += s.ended;
    }
    const std::string label = result.is_comparison() ? "pairs, " + world.broadphase : "pairs";
    fmt::format_to(to, "{:<20}{} at the end, {} begun, {} ended\n", label,
                   grouped(world.steps.empty() ? 0 : world.steps.back().pairs), grouped(begun), grouped(ended));
  }
  if (!result.pairs_equal) return;
  if (*result.pairs_equal)
    fmt::format_to(to, "{:<20}yes, in every step ({} steps, both worlds)\n", "pairs equal",
                   result.worlds[0].steps.size());
  else
    fmt::format_to(to, "{:<20}no: {}\n", "pairs equal", result.first_difference);
}

}  // namespace

std::string result_table(const scenes::Scene& scene, const RunResult& result) {
  std::string out;
  auto to = std::back_inserter(out);
  const WorldRun& first = result.worlds.front();
  fmt::format_to(to, "{:<14}{}: {}\n", "scene", files::printable(scene.meta.name), files::printable(scene.meta.about));
  fmt::format_to(to, "{:<14}{}\n", "objects", census_text(first.simulation->census()));
  fmt::format_to(to, "{:<14}{} of {:.4g} s\n", "steps", first.steps.size(), scene.time.dt);
  if (scene.solver.precision == scenes::Precision::doubled) fmt::format_to(to, "{:<14}double\n", "precision");
  fmt::format_to(to, "{:<14}{}", "broad-phase", first.broadphase);
  if (result.is_comparison()) fmt::format_to(to, ", beside {}", result.worlds[1].broadphase);
  fmt::format_to(to, "\n{:<14}{}\n", "effects", effects_text(*first.simulation));
  for (const effects::SwitchedOn& late : first.simulation->switched_on())
    fmt::format_to(to, "{:<14}{} in step {}: {}\n", "switched on", late.effect->name, late.step, late.reason);
  out += activity_text(*first.simulation);
  out += energy_lines(first.simulation->energy_balance());
  out += vitals_lines(first);
  fmt::format_to(to, "{:<14}{}\n\n", "times", clock_text(first.simulation->clock()));
  print_times(out, result);
  out += "\n";
  print_pairs(out, result);
  if (const std::string checks = check_lines(scene, result); !checks.empty()) out += "\n" + checks;
  return out;
}

}  // namespace boxstream::tool
