// SPDX-License-Identifier: MIT
#include "simulation/simulation_parts.hpp"

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

void ask(const Simulation& simulation, const Check& check, Verdict& verdict) {
  if (verdict.asked && !verdict.passed) return;
  verdict.value = simulation.metric(check.metric);
  verdict.step = simulation.steps_done();
  verdict.passed = holds(verdict.value, check.op, check.value);
  verdict.asked = true;
}

}  // namespace

void Simulation::Impl::begin_checks() {
  first_energy = self.metric(Check::Metric::energy);
  world.solver().take_residual();
  verdicts.resize(scene.checks.size());
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    verdicts[i].check = i;
    count_missed = count_missed || scene.checks[i].metric == Check::Metric::missed_pairs;
  }
}

void Simulation::Impl::observe() {
  residual = world.solver().take_residual();
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    const Check& check = scene.checks[i];
    if (!check.at_end && (check.at == 0 || check.at == stage.steps)) ask(self, check, verdicts[i]);
  }
}

std::vector<Verdict> Simulation::verdicts() const {
  std::vector<Verdict> verdicts = impl_->verdicts;
  for (Verdict& verdict : verdicts)
    if (const Check& check = impl_->scene.checks[verdict.check]; check.at_end) ask(*this, check, verdict);
  return verdicts;
}

}  // namespace boxstream::scenes
