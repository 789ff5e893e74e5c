// SPDX-License-Identifier: MIT
#include "measure.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace boxstream::bench {

namespace {

double thread_milliseconds() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace

Series summarize(std::vector<double> samples) {
  if (samples.empty()) return {};
  std::sort(samples.begin(), samples.end());
  const std::size_t middle = samples.size() / 2;
  const double median = samples.size() % 2 ? samples[middle] : (samples[middle - 1] + samples[middle]) / 2;
  return {median, samples.front()};
}

double time_once(const std::function<void()>& run) {
  const double start = thread_milliseconds();
  run();
  return thread_milliseconds() - start;
}

InterruptionWatch::InterruptionWatch() : wall_(std::chrono::steady_clock::now()), thread_ms_(thread_milliseconds()) {}

bool InterruptionWatch::interrupted() const {
  const double wall = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - wall_).count();
  const double lost = wall - (thread_milliseconds() - thread_ms_);
  return lost > 0.02 * wall && lost > 0.1;
}

std::vector<Series> measure_interleaved(const std::vector<std::function<void()>>& contestants,
                                        const Interleaving& interleaving, const std::function<void(int)>& on_round) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  std::vector<int> calls;
  for (const auto& run : contestants)
    calls.push_back(std::max(1, static_cast<int>(std::ceil(interleaving.min_sample_ms / (time_once(run) + 1e-6)))));

  std::vector<std::vector<double>> samples(contestants.size());
  for (int round = 0; round < interleaving.repeats; ++round) {
    if (round >= 3 && seconds() > interleaving.budget_seconds) break;
    on_round(round);
    for (std::size_t i = 0; i < contestants.size(); ++i) {
      const double total = time_once([&] {
        for (int call = 0; call < calls[i]; ++call) contestants[i]();
      });
      samples[i].push_back(total / calls[i]);
    }
  }
  std::vector<Series> series;
  for (auto& s : samples) series.push_back(summarize(std::move(s)));
  return series;
}

}  // namespace boxstream::bench
