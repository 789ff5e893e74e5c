// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "measure.hpp"
#include "progress.hpp"
#include "report.hpp"

namespace boxstream::bench {

struct Options {
  bool quick = false;
  std::vector<std::string> cases;  ///< empty: the suite's own choice
  std::vector<std::size_t> sizes;  ///< empty: the suite's own choice
  std::vector<std::string> peers;  ///< empty: the suite's own choice
  std::uint64_t seed = 1;
  int steps = 0;              ///< of each world in the bullet suite; 0: as the scene says, fewer with `quick`
  double limit_seconds = 10;  ///< a peer predicted to take longer than this for one run is skipped
  Interleaving interleaving;
};

/// Detector::find_pairs against the batch peers.
void run_batch_suite(const Options& options, Report& report, Progress& progress);

/// Whole worlds on Bullet: updateAabbs + calculateOverlappingPairs + dispatch of a step, and (case "NAME:step") all of
/// the step, on boxstream and on Bullet's own broad-phases, stepped in turn.
/// Present only where the scenes library is built (BOXSTREAM_BENCH_BULLET).
void run_bullet_suite(const Options& options, Report& report, Progress& progress);
bool is_scene(const std::string& name);

}  // namespace boxstream::bench
