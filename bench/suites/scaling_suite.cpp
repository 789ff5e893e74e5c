// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <thread>

#include <boxstream/executor.hpp>

#include "inputs/batches.hpp"
#include "peers/pair_hash.hpp"
#include "peers/radix_sort.hpp"
#include "suites/batch_contest.hpp"
#include "suites/suites.hpp"
#include "tables/report.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t largest_n_of_peers = 1000000;

/// Says that it has many threads which are awake, and runs everything on the calling one. What that does outside of
/// tasks takes as long with any number of threads.
class SerialShare final : public Executor {
 public:
  unsigned concurrency() const override { return 64; }
  std::uint32_t start_nanoseconds() override { return 0; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    in_tasks_ms_ += measure::time_once([&] {
      for (std::size_t i = 0; i < count; ++i) task(i);
    });
  }
  double in_tasks_ms() const { return in_tasks_ms_; }

 private:
  double in_tasks_ms_ = 0;
};

/// One thread against several of ours, by the clock on the wall, and against one sort of n keys.
class OwnScaling {
 public:
  OwnScaling(const Options& options, Ours& ours, Report& report, Progress& progress)
      : options_(options), ours_(ours), report_(report), progress_(progress) {}

  void run(const std::string& name, std::size_t n) {
    const std::vector<Aabb> boxes = batches::make(name, n, options_.seed);
    OurMethod& alone = ours_.on(1);
    OurMethod& together = ours_.on(options_.threads);
    progress_.show(fmt::format("scaling {} n={}", name, n));
    // The first runs warm everything up, and compare the pairs.
    alone.find_pairs(boxes, pairs_);
    const std::vector<Pair> expected = pairs_;
    bool same = true;
    for (int run = 0; run < 3; ++run) {  // threads are awake in the later ones
      together.find_pairs(boxes, pairs_);
      same = same && pairs_ == expected;
    }
    const auto search_alone = [&] { alone.find_pairs(boxes, pairs_); };
    const auto search_together = [&] { together.find_pairs(boxes, pairs_); };
    const auto twice = [](const auto& search) {
      return [&search] {
        search();
        search();
      };
    };
    const auto rest = [] { std::this_thread::sleep_for(std::chrono::milliseconds(5)); };
    const double one_call = options_.interleaving.min_sample_ms;
    const std::vector<Series> series =
        measure_interleaved({{search_alone},
                             {[&] { sort_.sort(boxes); }},
                             {search_alone, twice(search_alone), [] {}, Clock::wall},
                             {search_together, twice(search_together), [] {}, Clock::wall},
                             {search_alone, rest, [] {}, Clock::wall, one_call},
                             {search_together, rest, [] {}, Clock::wall, one_call}},
                            options_.interleaving, [](int) {});
    progress_.clear();

    Row row{.suite = "scaling", .case_name = name, .n = n, .k = expected.size(), .pairs_equal = {}, .yardstick = true};
    add(row, "radix-sort", series[0], series[1], alone);
    add_serial_share(row, boxes, expected);

    row.clock = clock_name(Clock::wall);
    row.threads = options_.threads;
    row.pairs_equal = same;
    add(row, "one-thread", series[3], series[2], together);
    add(row, "one-thread:rested", series[5], series[4], together);
  }

 private:
  void add(Row row, const std::string& peer, const Series& ours, const Series& theirs, const OurMethod& method) {
    row.peer = peer;
    row.set_ours(ours);
    row.set_peer(theirs);
    row.scratch_bytes = method.scratch_bytes();
    report_.add(std::move(row));
  }

  /// The time of a search as for many threads, and beside it what of it no number of threads makes shorter.
  void add_serial_share(Row row, const std::vector<Aabb>& boxes, const std::vector<Pair>& expected) {
    SerialShare executor;
    const std::unique_ptr<OurMethod> method = make_detector(&executor);
    method->find_pairs(boxes, pairs_);
    row.pairs_equal = pairs_ == expected;
    std::vector<double> all, outside;
    for (int i = 0; i < 2 * options_.interleaving.repeats; ++i) {
      const double before = executor.in_tasks_ms();
      all.push_back(measure::time_once([&] { method->find_pairs(boxes, pairs_); }));
      outside.push_back(all.back() - (executor.in_tasks_ms() - before));
    }
    add(row, serial_share, summarize(all), summarize(outside), *method);
  }

  const Options& options_;
  Ours& ours_;
  Report& report_;
  Progress& progress_;
  RadixSort sort_;
  std::vector<Pair> pairs_;
};

}  // namespace

void run_scaling_suite(const Options& options, Report& report, Progress& progress) {
  const auto cases = options.cases_or({"U"}, {"U"});
  const auto sizes = options.sizes_or({100, 2000, 10000, 100000}, {100, 1000, 2000, 10000, 100000, 1000000, 10000000});
  std::vector<PeerConfig> peers = choose_peers(make_peers(options.threads), options.peers);
  Ours ours(make_detector);
  BatchContest contest({"scaling", options, ours, peers, report, progress});
  OwnScaling own(options, ours, report, progress);
  for (const std::size_t n : sizes)
    for (const std::string& name : cases) {
      if (n <= largest_n_of_peers) contest.run(name, n);
      own.run(name, n);
    }
}

}  // namespace boxstream::bench
