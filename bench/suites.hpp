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
  std::uint64_t seed = 1;
  double limit_seconds = 10;  ///< a peer predicted to take longer than this for one run is skipped
  Interleaving interleaving;
};

/// Detector::find_pairs against the batch peers.
void run_batch_suite(const Options& options, Report& report, Progress& progress);

}  // namespace boxstream::bench
