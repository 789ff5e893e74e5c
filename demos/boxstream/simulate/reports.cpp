// SPDX-License-Identifier: MIT
#include "boxstream/simulate/reports.hpp"

#include <fmt/format.h>

#include "base/words.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/simulate/step_files.hpp"

namespace boxstream::tool {
namespace {

std::string outcome(const scenes::CheckResult& result) {
  if (!result.asked) return "not evaluated: the run was too short";
  return fmt::format("{}: {:.6g} after step {}", result.passed ? "passed" : "FAILED", result.value, result.step);
}

using scenes::Vitals;
using scenes::WorstMoment;

std::string told(const scenes::Simulation& simulation, int object) {
  if (object < 0) return "the world";
  const std::string name = object_name(simulation, static_cast<std::size_t>(object));
  return name.empty() ? fmt::format("{}", object) : fmt::format("{} ({})", object, files::printable(name));
}

std::string moment_text(const scenes::Simulation& simulation, const WorstMoment& moment) {
  return fmt::format(" in step {}, {} and {}", moment.step, told(simulation, moment.objects[0]),
                     told(simulation, moment.objects[1]));
}

nlohmann::ordered_json moment_json(const WorstMoment& moment) {
  if (moment.step == 0) return nullptr;
  return {{"step", moment.step}, {"objects", moment.objects}};
}

}  // namespace

std::string check_text(const scenes::Check& check) {
  const std::string when = check.at_end    ? "at the end"
                           : check.at == 0 ? "always"
                                           : fmt::format("after step {}", check.at);
  return fmt::format("{} {} {:g}, {}", name_of(check.metric), name_of(check.op), check.value, when);
}

std::string check_lines(const scenes::Scene& scene, const RunResult& result) {
  std::string out;
  for (const scenes::CheckResult& check : result.worlds.front().simulation->check_results())
    out += fmt::format("{:<14}{}: {}\n", "check", check_text(scene.checks[check.check]), outcome(check));
  return out;
}

std::string first_failed_check(const scenes::Scene& scene, const RunResult& result) {
  for (const WorldRun& world : result.worlds)
    for (const scenes::CheckResult& check : world.simulation->check_results())
      if (!check.passed)
        return fmt::format("check failed on {}: {} ({})", world.broadphase, check_text(scene.checks[check.check]),
                           outcome(check));
  return {};
}

std::array<std::pair<const char*, double>, 5> parts_of(const scenes::Work& work) {
  return {{{"fields", work.fields},
           {"motors", work.motors},
           {"surfaces", work.surfaces},
           {"apart", work.apart},
           {"other", work.other}}};
}

std::string energy_lines(const scenes::EnergyBalance& balance) {
  if (balance.steps == 0 || (balance.first == 0 && balance.now == 0)) return {};
  std::string text = fmt::format("{:<14}{:.5g} J at the start, {:.5g} J at the end; {:.5g} J lost\n", "energy",
                                 balance.first, balance.now, balance.lost());
  std::string work;
  for (const auto& [name, joules] : parts_of(balance.work))
    if (joules != 0) work += fmt::format("{}{} {:.4g} J", work.empty() ? "" : ", ", name, joules);
  if (!work.empty()) text += fmt::format("{:<14}{}\n", "work", work);
  return text;
}

std::string gained_energy(const scenes::Simulation& simulation) {
  const scenes::EnergyBalance balance = simulation.energy_balance();
  if (!balance.worst) return {};
  const scenes::Gain& worst = *balance.worst;
  const std::string name = object_name(simulation, static_cast<std::uint32_t>(worst.body));
  return fmt::format(
      "{} of {} steps gained energy that no work explains; most in step {}: {:.4g} J, {:.3g} % of what is in the "
      "world, "
      "most of it body {}{}",
      balance.gains, balance.steps, worst.step, worst.energy, 100 * worst.share, worst.body,
      name.empty() ? "" : fmt::format(" ({})", files::printable(name)));
}

std::string vitals_lines(const WorldRun& world) {
  const Vitals& v = world.vitals;
  const scenes::Simulation& simulation = *world.simulation;
  std::string text = fmt::format("{:<14}{:.3g} m at the deepest", "penetration", v.deepest);
  if (v.when_deepest.step > 0) text += moment_text(simulation, v.when_deepest);
  if (v.deepest_share > 0) text += fmt::format("; up to {:.2g} % of the thinner one", 100 * v.deepest_share);
  text += fmt::format("\n{:<14}{:.3g} m at the widest", "joint gap", v.joint_gap);
  if (v.when_widest.step > 0) text += moment_text(simulation, v.when_widest);
  text += fmt::format("\n{:<14}{:.3g} J beyond work in all, at most {:.3g} J in a step; in {} steps\n", "gained",
                      v.most_gained, v.energy.worst ? v.energy.worst->energy : 0, grouped(v.energy.gains));
  text += fmt::format("{:<14}{} bodies, out of the world's bounds at the end\n", "lost", grouped(v.outside));
  return text;
}

nlohmann::ordered_json vitals_json(const WorldRun& world) {
  const Vitals& v = world.vitals;
  return {{"deepest_m", v.deepest},
          {"deepest_share", v.deepest_share},
          {"when_deepest", moment_json(v.when_deepest)},
          {"joint_gap_m", v.joint_gap},
          {"joint_gap_share", v.joint_share},
          {"when_widest", moment_json(v.when_widest)},
          {"energy_gained_j", v.most_gained},
          {"steps_that_gained", v.energy.gains},
          {"bodies_lost", v.outside}};
}

std::string doubts(const WorldRun& world) {
  Vitals rest = world.vitals;
  rest.failed_checks.clear();
  rest.energy.worst.reset();
  return scenes::unsound(rest);
}

}  // namespace boxstream::tool
