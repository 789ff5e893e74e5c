// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>

#include "batch_contest.hpp"
#include "batches/batches.hpp"
#include "pair_hash.hpp"
#include "radix_sort.hpp"
#include "suites.hpp"

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
    OurWay& alone = ours_.on(1);
    OurWay& together = ours_.on(options_.threads);
    progress_.show(fmt::format("scaling {} n={}", name, n));
    // The first runs warm everything up, and tell whether all find the same.
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

    Row row;
    row.suite = "scaling";
    row.case_name = name;
    row.n = n;
    row.k = expected.size();
    row.yardstick = true;
    row.pairs_equal.reset();
    add(row, "radix-sort", series[0], series[1], alone);

    row.clock = clock_name(Clock::wall);
    row.threads = options_.threads;
    row.pairs_equal = same;
    add(row, "one-thread", series[3], series[2], together);
  }

 private:
  void add(Row row, const std::string& peer, const Series& ours, const Series& theirs, const OurWay& way) {
    row.peer = peer;
    row.ours_ms = ours.median;
    row.ours_min = ours.min;
    row.peer_ms = theirs.median;
    row.peer_min = theirs.min;
    row.samples = theirs.samples;
    row.scratch_bytes = way.scratch_bytes();
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
  const std::vector<std::string> cases = options.cases.empty() ? std::vector<std::string>{"U"} : options.cases;
  std::vector<std::size_t> sizes = options.sizes;
  if (sizes.empty())
    sizes = options.quick ? std::vector<std::size_t>{100, 1000, 10000, 100000}
                          : std::vector<std::size_t>{100, 1000, 10000, 100000, 1000000, 10000000};
  std::sort(sizes.begin(), sizes.end());

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
