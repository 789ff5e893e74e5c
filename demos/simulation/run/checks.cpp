// SPDX-License-Identifier: MIT
#include "simulation/run/simulation_parts.hpp"

namespace boxstream::scenes {
namespace {

// A NaN passes nothing.
bool holds(double value, Check::Op op, double bound) {
  switch (op) {
    case Check::Op::less:
      return value < bound;
    case Check::Op::at_most:
      return value <= bound;
    case Check::Op::equal:
      return value == bound;
    case Check::Op::at_least:
      return value >= bound;
    case Check::Op::greater:
      return value > bound;
  }
  return false;
}

void ask(const Simulation& simulation, const Check& check, CheckResult& result) {
  if (result.asked && !result.passed) return;
  result.value = simulation.metric(check.metric);
  result.step = simulation.steps_done();
  result.passed = holds(result.value, check.op, check.value);
  result.asked = true;
}

}  // namespace

void Simulation::Impl::begin_checks() {
  first_energy = self.metric(Check::Metric::energy);
  energy_scale = self.energy_scale();
  world.solver().take_residual();
  check_results.resize(scene.checks.size());
  for (std::size_t i = 0; i < check_results.size(); ++i) {
    check_results[i].check = i;
    count_missed = count_missed || scene.checks[i].metric == Check::Metric::missed_pairs;
  }
}

void Simulation::Impl::observe() {
  residual = world.solver().take_residual();
  for (std::size_t i = 0; i < check_results.size(); ++i) {
    const Check& check = scene.checks[i];
    if (!check.at_end && (check.at == 0 || check.at == instance.steps)) ask(self, check, check_results[i]);
  }
}

std::vector<CheckResult> Simulation::check_results() const {
  std::vector<CheckResult> check_results = impl_->check_results;
  for (CheckResult& result : check_results)
    if (const Check& check = impl_->scene.checks[result.check]; check.at_end) ask(*this, check, result);
  return check_results;
}

}  // namespace boxstream::scenes
