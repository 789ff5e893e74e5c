// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

#include "inputs/motion.hpp"
#include "suites/contest.hpp"
#include "suites/predictor.hpp"

namespace boxstream::bench {

/// Compares one of our methods with peers over the same frames, and adds a row for each family of peers.
///
/// Contestants are interleaved by blocks: within a block of frames the memory of each is as warm as in a program of its
/// own. After each frame the pairs are hashed together with those of all frames before.
class FrameContest {
 public:
  explicit FrameContest(Contest contest) : contest_(std::move(contest)) {}

  /// `case_name` is "BATCH:MOTION".
  void run(const std::string& case_name, std::size_t n);

 private:
  struct Runner {
    std::string name;
    std::string family;
    std::string known_difference;
    Peer* peer;
    std::vector<Pair> pairs;
    std::vector<double> frame_ms;
    std::vector<std::uint64_t> chain;  // of hashes, one a frame
    double filling_ms = 0, total_ms = 0;
    bool stopped = false;

    void see_pairs();
  };

  void show(const std::string& what);
  void choose_runners();
  double cheapest_run_ms(Peer& peer, std::size_t n);
  void run_blocks();
  void run_block(Runner& runner, const std::vector<std::vector<Aabb>>& frames);
  Row row_of(const Runner& runner) const;

  const Contest contest_;
  Predictor predictor_;

  // Of the case that runs.
  std::string case_name_, batch_;
  Motion motion_{};
  std::size_t n_ = 0;
  std::vector<std::uint32_t> moved_;
  std::vector<Runner> runners_;  // ours is the first
  std::vector<Row> skipped_;
};

/// "U:brown" and the like. Throws std::invalid_argument if there is no such motion.
bool is_motion_case(const std::string& case_name);

}  // namespace boxstream::bench
