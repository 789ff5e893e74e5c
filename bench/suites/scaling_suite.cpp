// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>

#include "inputs/batches.hpp"
#include "peers/pair_hash.hpp"
#include "peers/radix_sort.hpp"
#include "suites/batch_contest.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t largest_n_of_peers = 1000000;

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
    together.find_pairs(boxes, pairs_);
    const bool same = pairs_ == expected;
    const auto search_alone = [&] { alone.find_pairs(boxes, pairs_); };
    const std::vector<Series> series =
        measure_interleaved({{search_alone},
                             {[&] { sort_.sort(boxes); }},
                             {search_alone, [] {}, [] {}, Clock::wall},
                             {[&] { together.find_pairs(boxes, pairs_); }, [] {}, [] {}, Clock::wall}},
                            options_.interleaving, [](int) {});
    progress_.clear();

    Row row{.suite = "scaling", .case_name = name, .n = n, .k = expected.size(), .pairs_equal = {}, .yardstick = true};
    add(row, "radix-sort", series[0], series[1], alone);

    row.clock = clock_name(Clock::wall);
    row.threads = options_.threads;
    row.pairs_equal = same;
    add(row, "one-thread", series[3], series[2], together);
  }

 private:
  void add(Row row, const std::string& peer, const Series& ours, const Series& theirs, const OurMethod& method) {
    row.peer = peer;
    row.set_ours(ours);
    row.set_peer(theirs);
    row.scratch_bytes = method.scratch_bytes();
    report_.add(std::move(row));
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
  const auto sizes = options.sizes_or({100, 1000, 10000, 100000}, {100, 1000, 10000, 100000, 1000000, 10000000});
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
