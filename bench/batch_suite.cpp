// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>

#include <boxstream/detector.hpp>

#include "batches/batches.hpp"
#include "pair_hash.hpp"
#include "peers/peer.hpp"
#include "suites.hpp"

namespace boxstream::bench {

namespace {

/// A configuration within this factor of its family's best in the trial run takes part in the rounds too: one run is
/// too noisy to pick a winner by.
constexpr double contender_factor = 1.2;

struct Contestant {
  const PeerConfig* config;
  bool pairs_equal;
};

/// What one run at n should take: extrapolated from n / 100 and n / 10 by the power law through them.
double predict_ms(Peer& peer, const std::string& name, std::size_t n, std::uint64_t seed) {
  std::vector<Pair> pairs;
  double ms[2];
  const std::size_t sizes[2] = {n / 100, n / 10};
  for (int i = 0; i < 2; ++i) {
    const std::vector<Aabb> boxes = batches::make(name, sizes[i], seed);
    ms[i] = time_once([&] { peer.find_pairs(boxes, pairs); });
  }
  return ms[1] * std::clamp(ms[1] / ms[0], 5.0, 100.0);
}

class BatchCase {
 public:
  BatchCase(const std::string& name, std::size_t n, const Options& options, Report& report, Progress& progress)
      : name_(name), n_(n), options_(options), report_(report), progress_(progress) {}

  void run(std::vector<PeerConfig>& peers) {
    boxes_ = batches::make(name_, n_, options_.seed);
    const auto ours = [&] { detector_.find_pairs(boxes_, our_pairs_); };
    show("ours");
    ours();
    expected_ = summarize(our_pairs_);
    row_.suite = "batch";
    row_.case_name = name_;
    row_.n = n_;
    row_.k = expected_.count;

    std::vector<Contestant> contestants;
    std::vector<Row> skipped;
    for (std::size_t first = 0; first < peers.size();) {
      std::size_t last = first;
      while (last < peers.size() && peers[last].family == peers[first].family) ++last;
      try_family(peers, first, last, contestants, skipped);
      first = last;
    }

    std::vector<std::function<void()>> runs{ours};
    for (const Contestant& c : contestants)
      runs.push_back([this, peer = c.config->peer.get()] { peer->find_pairs(boxes_, peer_pairs_); });
    const auto series = measure_interleaved(runs, options_.interleaving, [&](int round) {
      show(fmt::format("round {} of {}", round + 1, options_.interleaving.repeats));
    });
    progress_.clear();
    row_.ours_ms = series[0].median;
    row_.ours_min = series[0].min;

    for (std::size_t i = 0; i < contestants.size(); ++i) {
      if (!is_best_of_family(contestants, series, i)) continue;
      Row row = row_;
      row.peer = contestants[i].config->name;
      row.peer_ms = series[i + 1].median;
      row.peer_min = series[i + 1].min;
      row.pairs_equal = contestants[i].pairs_equal;
      report_.add(std::move(row));
    }
    for (Row& row : skipped) {
      row.ours_ms = row_.ours_ms;
      row.ours_min = row_.ours_min;
      report_.add(std::move(row));
    }
  }

 private:
  void show(const std::string& what) { progress_.show(fmt::format("batch {} n={}: {}", name_, n_, what)); }

  /// Runs each configuration of a family once, to check its pairs and to see which are worth repeating.
  void try_family(std::vector<PeerConfig>& peers, std::size_t first, std::size_t last,
                  std::vector<Contestant>& contestants, std::vector<Row>& skipped) {
    std::vector<std::pair<double, Contestant>> trials;
    double best = 0, quickest_prediction = 0;
    bool tried = false;
    for (std::size_t i = first; i < last; ++i) {
      PeerConfig& config = peers[i];
      if (n_ > config.largest_n) continue;
      show(config.name + ", trial");
      if (n_ >= 20000) {
        const double predicted = predict_ms(*config.peer, name_, n_, options_.seed);
        if (quickest_prediction == 0 || predicted < quickest_prediction) quickest_prediction = predicted;
        if (predicted > 1000 * options_.limit_seconds) continue;
      }
      const double ms = time_once([&] { config.peer->find_pairs(boxes_, peer_pairs_); });
      best = tried ? std::min(best, ms) : ms;
      tried = true;
      trials.push_back({ms, {&config, summarize(peer_pairs_) == expected_}});
    }
    // Wrong pairs are reported whatever the time.
    for (const auto& [ms, contestant] : trials)
      if (ms <= contender_factor * best || !contestant.pairs_equal) contestants.push_back(contestant);
    if (trials.empty() && quickest_prediction > 0) {
      Row row = row_;
      row.peer = peers[first].family;
      row.skipped = fmt::format("about {:.0f} s a run predicted", quickest_prediction / 1000);
      skipped.push_back(std::move(row));
    }
  }

  static bool is_best_of_family(const std::vector<Contestant>& contestants, const std::vector<Series>& series,
                                std::size_t i) {
    if (!contestants[i].pairs_equal) return true;
    for (std::size_t j = 0; j < contestants.size(); ++j) {
      if (j == i || contestants[j].config->family != contestants[i].config->family) continue;
      const double mine = series[i + 1].median, other = series[j + 1].median;
      if (other < mine || (other == mine && j < i)) return false;
    }
    return true;
  }

  std::string name_;
  std::size_t n_;
  const Options& options_;
  Report& report_;
  Progress& progress_;

  std::vector<Aabb> boxes_;
  Detector detector_;
  std::vector<Pair> our_pairs_, peer_pairs_;
  PairSummary expected_;
  Row row_;
};

}  // namespace

void run_batch_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> cases = options.cases;
  if (cases.empty())
    cases = options.quick
                ? std::vector<std::string>{"U", "D", "S", "M", "P"}
                : std::vector<std::string>{"U", "D", "S", "M", "P", "Px", "Py", "C", "W1", "W2", "W3", "R", "X"};
  std::vector<std::size_t> sizes = options.sizes;
  if (sizes.empty())
    sizes =
        options.quick ? std::vector<std::size_t>{1000, 100000} : std::vector<std::size_t>{1000, 10000, 100000, 1000000};

  std::vector<PeerConfig> peers = make_peers();
  for (const std::string& wanted : options.peers)
    if (std::none_of(peers.begin(), peers.end(), [&](const PeerConfig& peer) { return peer.family == wanted; }))
      throw std::invalid_argument(fmt::format("no peer '{}' in the batch suite", wanted));
  if (!options.peers.empty())
    std::erase_if(peers, [&](const PeerConfig& peer) {
      return std::find(options.peers.begin(), options.peers.end(), peer.family) == options.peers.end();
    });
  for (const std::size_t n : sizes)
    for (const std::string& name : cases) BatchCase(name, n, options, report, progress).run(peers);
}

}  // namespace boxstream::bench
