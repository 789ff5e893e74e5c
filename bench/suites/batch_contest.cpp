// SPDX-License-Identifier: MIT
#include "suites/batch_contest.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "inputs/batches.hpp"

namespace boxstream::bench {

namespace {

/// A configuration within this factor of its family's best in the trial run takes part in the rounds too: one run is
/// too noisy to pick a winner by.
constexpr double contender_factor = 1.2;

Clock clock_for(unsigned threads) {
  return threads > 1 ? Clock::wall : Clock::cpu;
}

}  // namespace

double time_peer(Peer& peer, Span<const Aabb> boxes, std::vector<Pair>& pairs, Clock clock) {
  peer.prepare(boxes);
  const double ms = time_once([&] { peer.find_pairs(boxes, pairs); }, clock);
  peer.release();
  return ms;
}

void BatchContest::show(const std::string& what) {
  contest_.progress.show(fmt::format("{} {} n={}: {}", contest_.suite, name_, boxes_.size(), what));
}

Row BatchContest::row_of(const std::string& peer, unsigned threads) const {
  Row row = contest_.row_of(name_, boxes_.size(), peer);
  row.k = expected_.count;
  row.threads = threads;
  row.clock = clock_name(clock_for(threads));
  return row;
}

double BatchContest::predict_ms(PeerConfig& config) {
  return predictor_.predict(name_ + ' ' + config.name, boxes_.size(), contest_.limit_ms(), [&](std::size_t n) {
    const std::vector<Aabb> boxes = batches::make(name_, n, contest_.options.seed);
    return time_peer(*config.peer, boxes, peer_pairs_, clock_for(config.threads));
  });
}

/// Runs each configuration of a family once, to check its pairs and to see which are worth repeating.
std::vector<BatchContest::Trial> BatchContest::try_family(Span<PeerConfig> family) {
  std::vector<Trial> trials;
  double best = 0, quickest_prediction = 0;
  for (PeerConfig& config : family) {
    show(config.name + ", trial");
    const double predicted = predict_ms(config);
    if (predicted > contest_.limit_ms()) {
      if (quickest_prediction == 0 || predicted < quickest_prediction) quickest_prediction = predicted;
      continue;
    }
    const double ms = time_peer(*config.peer, boxes_, peer_pairs_, clock_for(config.threads));
    predictor_.add(name_ + ' ' + config.name, boxes_.size(), ms);
    best = trials.empty() ? ms : std::min(best, ms);
    trials.push_back({&config, ms, summarize(peer_pairs_) == expected_});
  }
  if (trials.empty()) {
    Row row = row_of(family[0].family, family[0].threads);
    row.skipped = fmt::format("over limit, {:.2g} s a run or more predicted", quickest_prediction / 1000);
    skipped_.push_back(std::move(row));
  }
  // Wrong pairs are reported whatever the time.
  std::erase_if(trials, [&](const Trial& t) { return t.ms > contender_factor * best && t.pairs_equal; });
  return trials;
}

bool BatchContest::is_best_of_family(std::size_t trial) const {
  if (!trials_[trial].pairs_equal) return true;
  for (std::size_t other = 0; other < trials_.size(); ++other) {
    if (other == trial || trials_[other].config->family != trials_[trial].config->family) continue;
    const double mine = series_[trial].median, theirs = series_[other].median;
    if (theirs < mine || (theirs == mine && other < trial)) return false;
  }
  return true;
}

void BatchContest::run(const std::string& name, std::size_t n) {
  name_ = name;
  boxes_ = batches::make(name, n, contest_.options.seed);
  trials_.clear();
  skipped_.clear();
  show("ours");
  time_peer(contest_.ours.on(1), boxes_, our_pairs_, Clock::cpu);
  expected_ = summarize(our_pairs_);

  for (const Span<PeerConfig> family : contest_.families())
    for (const Trial& trial : try_family(family)) trials_.push_back(trial);

  std::vector<Contestant> contestants;
  const auto enter = [&](Peer& peer, std::vector<Pair>& pairs, unsigned threads, double expected_ms) {
    contestants.push_back({[&] { peer.find_pairs(boxes_, pairs); }, [&] { peer.prepare(boxes_); },
                           [&] { peer.release(); }, clock_for(threads), expected_ms});
  };
  // Peers first, so that their places are those of the trials.
  for (const Trial& trial : trials_) enter(*trial.config->peer, peer_pairs_, trial.config->threads, trial.ms);
  std::map<unsigned, std::size_t> our_places;  // by number of threads
  const auto place_of_ours = [&](unsigned threads) {
    const auto [place, is_new] = our_places.try_emplace(threads, contestants.size());
    if (is_new) enter(contest_.ours.on(threads), our_pairs_, threads, 0);
    return place->second;
  };
  place_of_ours(1);
  for (const Trial& trial : trials_) place_of_ours(trial.config->threads);
  for (const Row& row : skipped_) place_of_ours(row.threads);

  series_ = measure_interleaved(contestants, contest_.options.interleaving, [&](int round) {
    show(fmt::format("round {} of {}", round + 1, contest_.options.interleaving.repeats));
  });
  contest_.progress.clear();

  const auto add = [&](Row row) {
    const Series& ours = series_[our_places.at(row.threads)];
    row.set_ours(ours);
    row.scratch_bytes = contest_.ours.on(row.threads).scratch_bytes();
    contest_.report.add(std::move(row));
  };
  for (std::size_t i = 0; i < trials_.size(); ++i) {
    if (!is_best_of_family(i)) continue;
    const PeerConfig& config = *trials_[i].config;
    Row row = row_of(config.name, config.threads);
    row.set_peer(series_[i]);
    row.pairs_equal = trials_[i].pairs_equal;
    row.known_difference = config.known_difference;
    add(std::move(row));
  }
  for (Row& row : skipped_) add(std::move(row));
}

}  // namespace boxstream::bench
