// SPDX-License-Identifier: MIT
#include "boxstream/simulate/simulate.hpp"

#include <algorithm>

#include <btBulletCollisionCommon.h>
#include <fmt/format.h>

#include "base/sorted_sweep.hpp"
#include "simulation/run/pair_check.hpp"

namespace boxstream::tool {
namespace {

/// Steps between looks at the energy of all bodies, for a cost below a hundredth of that of steps.
constexpr std::uint64_t energy_every = 10;

using scenes::Shadow;
using scenes::Simulation;

std::string describe(const Simulation& simulation, Pair pair) {
  const auto uid = [&](std::uint32_t index) {
    const btBroadphaseProxy* const proxy = simulation.objects()[index]->getBroadphaseHandle();
    return proxy ? proxy->m_uniqueId : 0;
  };
  return fmt::format("objects {} and {} (uids {} and {})", pair.a, pair.b, uid(pair.a), uid(pair.b));
}

/// Compares the pairs of one world with those of another broad-phase fed with the same boxes.
class PairCheck {
 public:
  PairCheck(const Simulation& simulation, const std::string& other, std::string& first_difference)
      : simulation_(simulation), other_(other), shadow_(simulation, other), first_difference_(first_difference) {}

  /// Where Simulation::set_after_pairs calls.
  void compare() {
    shadow_.follow();
    if (!first_difference_.empty()) return;
    const std::string& name = simulation_.broadphase_name();
    const std::vector<Pair> held = scenes::overlapping_only(simulation_, scenes::held_pairs(simulation_));
    const std::vector<Pair> other = scenes::overlapping_only(simulation_, shadow_.pairs());
    std::string found;
    if (const auto difference = first_difference(held, other))
      found = fmt::format("{} has {}, {} has not", difference->in_first ? name : other_,
                          describe(simulation_, difference->pair), difference->in_first ? other_ : name);
    else
      found = scenes::check_pairs(simulation_);
    if (found.empty()) return;
    first_difference_ = fmt::format("step {}, world on {}: {}", simulation_.steps_done() + 1, name, found);
  }

 private:
  const Simulation& simulation_;
  std::string other_;
  Shadow shadow_;
  std::string& first_difference_;
};

}  // namespace

RunResult run(const scenes::Scene& scene, const std::string& broadphase, const std::optional<std::string>& compare,
              std::uint64_t steps, StatusLine& status, const Simulation::Wrap& wrap, effects::Extent extent,
              const std::vector<std::vector<Monitor*>>& monitors) {
  RunResult result;
  std::vector<std::string> names{broadphase};
  if (compare) names.push_back(*compare);
  for (const std::string& name : names) {
    status.say(fmt::format("building the world on {}", name));
    const bool first = result.worlds.empty();
    result.worlds.push_back(
        {name, std::make_unique<Simulation>(scene, name, first ? wrap : Simulation::Wrap{}, extent), {}, {}});
    result.worlds.back().steps.reserve(steps);
  }
  const std::size_t worlds = result.worlds.size();
  std::vector<std::unique_ptr<PairCheck>> checks(worlds);
  std::vector<scenes::VitalsMonitor> vitals;
  vitals.reserve(worlds);
  for (std::size_t i = 0; i < worlds; ++i) {
    Simulation& simulation = *result.worlds[i].simulation;
    vitals.emplace_back(simulation, energy_every);
    if (compare) checks[i] = std::make_unique<PairCheck>(simulation, names[1 - i], result.first_difference);
    const std::vector<Monitor*> own = i < monitors.size() ? monitors[i] : std::vector<Monitor*>();
    if (compare || !own.empty())
      simulation.set_after_pairs([&simulation, own, check = checks[i].get()] {
        if (check != nullptr) check->compare();
        for (Monitor* const monitor : own) monitor->after_pairs(simulation);
      });
    for (Monitor* const monitor : own) monitor->begin(simulation, steps);
  }

  for (std::uint64_t i = 0; i < steps; ++i) {
    for (std::size_t turn = 0; turn < worlds; ++turn) {
      WorldRun& world = result.worlds[(i + turn) % worlds];
      world.steps.push_back(world.simulation->step());
    }
    for (scenes::VitalsMonitor& each : vitals) each.look();
    for (std::size_t w = 0; w < std::min(worlds, monitors.size()); ++w)
      for (Monitor* const monitor : monitors[w]) monitor->after_step(*result.worlds[w].simulation);
    const scenes::StepResult& last = result.worlds[0].steps.back();
    status.step(i + 1, steps, last.bodies, last.pairs);
  }
  // The worlds are handed out; their monitors are not.
  for (std::size_t w = 0; w < worlds; ++w) {
    result.worlds[w].simulation->set_after_pairs({});
    result.worlds[w].vitals = vitals[w].vitals();
  }
  if (compare) result.pairs_equal = result.first_difference.empty();
  return result;
}

}  // namespace boxstream::tool
