// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace boxstream::bench {

namespace {

constexpr int fewest_rounds = 3;

double milliseconds(clockid_t clock) {
  std::timespec now{};
  clock_gettime(clock, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double thread_milliseconds() {
  return milliseconds(CLOCK_THREAD_CPUTIME_ID);
}

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

}  // namespace

Series summarize(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const std::size_t middle = samples.size() / 2;
  const double median = samples.size() % 2 ? samples[middle] : (samples[middle - 1] + samples[middle]) / 2;
  return {median, samples.front(), samples.size()};
}

std::string clock_name(Clock clock) {
  return clock == Clock::cpu ? "cpu" : "wall";
}

double time_once(const std::function<void()>& run, Clock clock) {
  const clockid_t id = clock == Clock::cpu ? CLOCK_THREAD_CPUTIME_ID : CLOCK_MONOTONIC;
  const double start = milliseconds(id);
  run();
  return milliseconds(id) - start;
}

InterruptionWatch::InterruptionWatch() : wall_(std::chrono::steady_clock::now()), thread_ms_(thread_milliseconds()) {}

bool InterruptionWatch::interrupted() const {
  const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall_).count();
  const double lost = wall - (thread_milliseconds() - thread_ms_);
  return lost > 0.02 * wall && lost > 0.1;
}

std::vector<Series> measure_interleaved(const std::vector<Contestant>& contestants, const Interleaving& interleaving,
                                        const std::function<void(int)>& on_round) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  std::vector<double> call_ms;
  for (const Contestant& contestant : contestants)
    call_ms.push_back(contestant.expected_ms > 0 ? contestant.expected_ms : sample(contestant, 1));

  std::vector<std::vector<double>> samples(contestants.size());
  for (int round = 0; round < interleaving.repeats; ++round) {
    if (round >= fewest_rounds && seconds() > interleaving.budget_seconds) break;
    on_round(round);
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      if (round >= fewest_rounds && call_ms[i] > interleaving.slow_ms) continue;
      const int calls = std::max(1, static_cast<int>(std::ceil(interleaving.min_sample_ms / (call_ms[i] + 1e-6))));
      samples[i].push_back(sample(contestants[i], calls) / calls);
    }
  }
  std::vector<Series> series;
  for (auto& s : samples) series.push_back(summarize(std::move(s)));
  return series;
}

}  // namespace boxstream::bench
