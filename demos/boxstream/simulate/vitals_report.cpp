// SPDX-License-Identifier: MIT
#include "boxstream/simulate/vitals_report.hpp"

#include <fmt/format.h>

#include "base/printable.hpp"
#include "boxstream/simulate/events_file.hpp"
#include "boxstream/simulate/table.hpp"

namespace boxstream::tool {
namespace {

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
