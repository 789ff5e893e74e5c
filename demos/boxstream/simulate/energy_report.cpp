// SPDX-License-Identifier: MIT
#include "boxstream/simulate/energy_report.hpp"

#include <fmt/format.h>

#include "base/printable.hpp"
#include "boxstream/simulate/events_file.hpp"

namespace boxstream::tool {

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

}  // namespace boxstream::tool
