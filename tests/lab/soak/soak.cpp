// SPDX-License-Identifier: MIT
// Mixed work for minutes, all of it compared with oracles, below a ceiling of memory.
#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <vector>

#include <CLI/CLI.hpp>

#include "load.hpp"

namespace {

using namespace boxstream::soak;
using Clock = std::chrono::steady_clock;

constexpr double mb = 1024.0 * 1024.0;

const std::map<std::string, std::unique_ptr<Load> (*)()> kinds{
    {"batch", batch_load}, {"world", world_load}, {"bullet", bullet_load}, {"fcl", fcl_load}};

struct Worker {
  std::string name;
  std::unique_ptr<Load> load;
  std::uint64_t rounds = 0;
  std::uint64_t compared = 0;
  double seconds = 0;
};

/// What is allocated and not given back, in MB.
double heap_now() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd) / mb;
}

double peak_resident() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

/// Beyond it `new` fails, and the run with it. Sanitizers reserve terabytes, so their runs have no ceiling.
void limit_memory([[maybe_unused]] double megabytes) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  const auto bytes = static_cast<rlim_t>(megabytes * mb);
  const rlimit limit{bytes, bytes};
  if (setrlimit(RLIMIT_DATA, &limit) != 0) throw std::runtime_error("the limit of memory cannot be set");
#endif
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What is held between rounds, highest in the first half of the run and in the second.
struct Growth {
  double before = 0;
  double after = 0;
  /// Buffers follow the largest input so far, which later seeds may still raise a little; a leak grows on and on.
  bool flat() const { return after <= 1.1 * before + 2; }
};

Growth growth(const std::vector<double>& heap) {
  const auto middle = heap.begin() + static_cast<std::ptrdiff_t>(heap.size() / 2);
  const auto highest = [](auto first, auto last) { return first == last ? 0.0 : *std::max_element(first, last); };
  return {highest(heap.begin(), middle), highest(middle, heap.end())};
}

int run(std::vector<Worker>& workers, double seconds, std::uint64_t seed) {
  const auto start = Clock::now();
  auto told = start;
  std::vector<double> heap;
  for (; heap.empty() || seconds_since(start) < seconds; ++seed) {
    for (Worker& worker : workers) {
      const auto began = Clock::now();
      try {
        worker.compared += worker.load->round(seed);
      } catch (const std::exception& error) {
        std::fprintf(stderr, "soak: %s, seed %llu: %s\nagain: boxstream_soak --load %s --seed %llu --minutes 0\n",
                     worker.name.c_str(), static_cast<unsigned long long>(seed), error.what(), worker.name.c_str(),
                     static_cast<unsigned long long>(seed));
        return 1;
      }
      ++worker.rounds;
      worker.seconds += seconds_since(began);
    }
    heap.push_back(heap_now());
    if (seconds_since(told) > 10) {
      told = Clock::now();
      std::fprintf(stderr, "%5.0f s  seed %llu  heap %.1f MB\n", seconds_since(start),
                   static_cast<unsigned long long>(seed), heap.back());
    }
  }
  std::puts("| Load | Rounds | Answers compared | Seconds |\n| --- | --- | --- | --- |");
  for (const Worker& worker : workers)
    std::printf("| %s | %llu | %llu | %.0f |\n", worker.name.c_str(), static_cast<unsigned long long>(worker.rounds),
                static_cast<unsigned long long>(worker.compared), worker.seconds);
  const Growth held = growth(heap);
  std::printf(
      "\nHeld between rounds: at most %.1f MB in the first half, %.1f MB in the second; peak of the process %.0f MB.\n",
      held.before, held.after, peak_resident());
  // Few rounds say nothing about growth.
  if (heap.size() < 20 || held.flat()) return 0;
  std::fprintf(stderr, "soak: memory grows\n");
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Mixed work, compared with oracles, under a ceiling of memory. Exit code 1: a wrong answer, or growth.");
  double minutes = 10, ceiling = 1024;
  std::uint64_t seed = 1;
  std::vector<std::string> names;
  app.add_option("--minutes", minutes, "How long; 0 is one round of each load")
      ->check(CLI::Range(0.0, 1e5))
      ->capture_default_str();
  app.add_option("--memory-mb", ceiling, "Beyond it allocations fail")
      ->check(CLI::Range(64.0, 1e6))
      ->capture_default_str();
  app.add_option("--seed", seed, "Of the first round; those that follow count up")->capture_default_str();
  app.add_option("--load", names, "Which (all): batch, bullet, fcl, world")->check(CLI::IsMember(kinds));
  CLI11_PARSE(app, argc, argv);

  std::vector<Worker> workers;
  for (const auto& [name, make] : kinds)
    if (names.empty() || std::find(names.begin(), names.end(), name) != names.end()) workers.push_back({name, make()});
  limit_memory(ceiling);
  return run(workers, 60 * minutes, seed);
}
