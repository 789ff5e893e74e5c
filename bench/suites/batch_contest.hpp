// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

#include "peers/pair_hash.hpp"
#include "suites/contest.hpp"
#include "suites/predictor.hpp"

namespace boxstream::bench {

/// Compares one of our methods with peers, batch by batch, and adds a row for each family of peers.
class BatchContest {
 public:
  explicit BatchContest(Contest contest) : contest_(std::move(contest)) {}

  void run(const std::string& name, std::size_t n);

 private:
  struct Trial {
    PeerConfig* config;
    double ms;
    bool pairs_equal;
  };

  void show(const std::string& what);
  double predict_ms(PeerConfig& config);
  std::vector<Trial> try_family(Span<PeerConfig> family);
  bool is_best_of_family(std::size_t trial) const;
  Row row_of(const std::string& peer, unsigned threads) const;

  const Contest contest_;
  Predictor predictor_;
  std::vector<Pair> our_pairs_, peer_pairs_;

  // Of the batch that runs.
  std::string name_;
  std::vector<Aabb> boxes_;
  PairSummary expected_;
  std::vector<Trial> trials_;   // that take part in the rounds
  std::vector<Series> series_;  // one a trial
  std::vector<Row> skipped_;
};

/// Milliseconds of one call, between `prepare` and `release`.
double time_peer(Peer& peer, Span<const Aabb> boxes, std::vector<Pair>& pairs, Clock clock);

}  // namespace boxstream::bench
