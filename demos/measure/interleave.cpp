// SPDX-License-Identifier: MIT
#include "measure/interleave.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <utility>

namespace boxstream::measure {
namespace {

constexpr int fewest_rounds = 3;

/// Milliseconds of `calls` calls.
double sample(const Contestant& contestant, int calls) {
  contestant.prepare();
  const double ms = time_once(
      [&] {
        for (int call = 0; call < calls; ++call) contestant.run();
      },
      contestant.clock);
  contestant.release();
  return ms;
}

/// The median of the calls of a turn.
double turn(const std::function<double()>& timed) {
  const int most = std::isnan(counted_instructions()) ? most_calls_in_turn : 1;
  const Elapsed elapsed;
  std::vector<double> calls;
  do calls.push_back(timed());
  while (static_cast<int>(calls.size()) < most && elapsed.milliseconds() < turn_ms);
  return median(std::move(calls));
}

}  // namespace

void interleave(std::size_t contestants, const Interleaving& rules, Order order,
                const std::function<void(int)>& on_round, const std::function<void(int, std::size_t)>& visit) {
  const Elapsed elapsed;
  std::mt19937_64 random(1);
  std::vector<std::size_t> places(contestants);
  std::iota(places.begin(), places.end(), std::size_t{0});
  for (int round = 0; round < rules.repeats; ++round) {
    if (round >= fewest_rounds && elapsed.seconds() > rules.budget_seconds) break;
    on_round(round);
    // std::shuffle differs between libraries.
    for (std::size_t i = contestants; order == Order::shuffled && i > 1; --i)
      std::swap(places[i - 1], places[random() % i]);
    for (const std::size_t i : places) visit(round, i);
  }
}

std::vector<Series> measure_interleaved(const std::vector<Contestant>& contestants, const Interleaving& rules,
                                        const std::function<void(int)>& on_round) {
  std::vector<double> call_ms;
  for (const Contestant& contestant : contestants)
    call_ms.push_back(contestant.expected_ms > 0 ? contestant.expected_ms : sample(contestant, 1));
  std::vector<std::vector<double>> samples(contestants.size());
  interleave(contestants.size(), rules, Order::forwards, on_round, [&](int round, std::size_t i) {
    if (round >= fewest_rounds && call_ms[i] > rules.slow_ms) return;
    const int calls = std::max(1, static_cast<int>(std::ceil(rules.min_sample_ms / (call_ms[i] + 1e-6))));
    samples[i].push_back(sample(contestants[i], calls) / calls);
  });
  std::vector<Series> series;
  for (const std::vector<double>& of_one : samples) series.push_back(summarize(of_one));
  return series;
}

Costs interleave_with_control(std::size_t candidates, int repeats, const std::function<double(std::size_t)>& timed,
                              const std::function<void(std::size_t)>& on_turn) {
  // The control comes last.
  std::vector<std::vector<double>> times(candidates + 1);
  std::vector<double> instructions(candidates + 1, NAN);
  const Interleaving rules{repeats, 0, std::numeric_limits<double>::infinity(), 0};
  interleave(
      times.size(), rules, Order::shuffled, [](int) {},
      [&](int, std::size_t i) {
        on_turn(i % candidates);
        const double before = counted_instructions();
        times[i].push_back(turn([&] { return timed(i % candidates); }));
        instructions[i] = counted_instructions() - before;
      });
  Costs costs;
  for (std::size_t i = 0; i < candidates; ++i) {
    costs.of.push_back(estimate(times[i]));
    costs.of.back().instructions = instructions[i];
  }
  costs.control_spread = std::abs(costs.of.front().median / median(times.back()) - 1);
  return costs;
}

}  // namespace boxstream::measure
