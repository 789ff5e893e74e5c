// SPDX-License-Identifier: MIT
#include <algorithm>

#include "inputs/batches.hpp"
#include "suites/batch_contest.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

bool is_batch(const std::string& name) {
  const Span<const batches::Batch> all = batches::all();
  return std::any_of(all.begin(), all.end(), [&](const batches::Batch& batch) { return batch.name == name; });
}

void run_batch_suite(const Options& options, Report& report, Progress& progress) {
  const auto cases =
      options.cases_or({"U", "S", "M", "P", "C", "W2", "R", "heap"},
                       {"U", "D",       "S",        "M",    "M2",   "P",      "C",    "W1",   "W2",    "W3",    "R",
                        "X", "lattice", "scaffold", "heap", "rods", "graded", "diag", "city", "voxel", "pareto"});
  const auto sizes = options.sizes_or({100, 1000, 100000}, {10, 32, 100, 1000, 10000, 100000, 1000000});
  std::vector<PeerConfig> peers = choose_peers(make_peers(options.threads), options.peers);
  Ours ours(make_detector);
  BatchContest contest({"batch", options, ours, peers, report, progress});
  for (const std::size_t n : sizes)
    for (const std::string& name : cases) contest.run(name, n);
}

}  // namespace boxstream::bench
