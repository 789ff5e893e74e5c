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

bool overlap(const Estimate& a, const Estimate& b) {
  return a.low <= b.high && b.low <= a.high;
}

/// Which candidates need more turns to be told from the others.
std::vector<bool> unsettled(const std::vector<std::vector<double>>& times, const Turns& turns) {
  std::vector<Estimate> of;
  for (const std::vector<double>& each : times) of.push_back(estimate(each));
  std::vector<bool> open(times.size());
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    bool mixed = false;
    for (std::size_t k = 0; k + 1 < times.size(); ++k) mixed = mixed || (k != i && overlap(of[i], of[k]));
    open[i] = mixed && of[i].high - of[i].low > turns.narrow_enough * of[i].median;
  }
  // The control goes on with the candidate that it is one of.
  open.back() = open.front();
  return open;
}

}  // namespace

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double quantile(std::vector<double> values, double p) {
  const auto at = static_cast<std::ptrdiff_t>(std::ceil(p * static_cast<double>(values.size())) - 1);
  const auto place = values.begin() + std::clamp<std::ptrdiff_t>(at, 0, std::ssize(values) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Series summarize(const std::vector<double>& samples) {
  if (samples.empty()) return {};
  return {median(samples), *std::min_element(samples.begin(), samples.end()), samples.size()};
}

Estimate estimate(const std::vector<double>& values) {
  constexpr int samples = 2000;
  std::mt19937_64 random(1);
  std::vector<double> medians, sample(values.size());
  for (int i = 0; i < samples; ++i) {
    for (double& value : sample) value = values[random() % values.size()];
    medians.push_back(median(sample));
  }
  return {median(values), quantile(medians, 0.025), quantile(medians, 0.975), quantile(values, 0), NAN};
}

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

Costs interleave_with_control(std::size_t candidates, const Turns& turns,
                              const std::function<double(std::size_t)>& timed,
                              const std::function<void(std::size_t)>& on_turn) {
  // The control comes last.
  std::vector<std::vector<double>> times(candidates + 1);
  std::vector<double> instructions(candidates + 1, NAN);
  std::vector<bool> open(candidates + 1, true);
  bool over = false;
  const Interleaving rules{turns.most, 0, std::numeric_limits<double>::infinity(), 0};
  interleave(
      times.size(), rules, Order::shuffled,
      [&](int round) {
        if (turns.narrow_enough > 0 && round >= turns.fewest && !over) open = unsettled(times, turns);
      },
      [&](int, std::size_t i) {
        over = over || turns.is_over();
        if (over || !open[i]) return;
        on_turn(i % candidates);
        const double before = counted_instructions();
        times[i].push_back(turn([&] { return timed(i % candidates); }));
        instructions[i] = counted_instructions() - before;
      });
  Costs costs;
  for (std::size_t i = 0; i < candidates; ++i) {
    costs.turns_of.push_back(static_cast<int>(times[i].size()));
    costs.of.push_back(times[i].empty() ? Estimate{} : estimate(times[i]));
    costs.of.back().instructions = instructions[i];
  }
  costs.fewest_turns = *std::min_element(costs.turns_of.begin(), costs.turns_of.end());
  costs.control_spread = times.front().empty() || times.back().empty()
                             ? NAN
                             : std::abs(costs.of.front().median / median(times.back()) - 1);
  return costs;
}

Costs interleave_with_control(std::size_t candidates, int repeats, const std::function<double(std::size_t)>& timed,
                              const std::function<void(std::size_t)>& on_turn) {
  Turns turns;
  turns.most = repeats;
  turns.narrow_enough = 0;
  return interleave_with_control(candidates, turns, timed, on_turn);
}

}  // namespace boxstream::measure
