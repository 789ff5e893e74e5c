// SPDX-License-Identifier: MIT
#include <algorithm>

#include "batch_contest.hpp"
#include "batches/batches.hpp"
#include "suites.hpp"

namespace boxstream::bench {

bool is_batch(const std::string& name) {
  const Span<const batches::Batch> all = batches::all();
  return std::any_of(all.begin(), all.end(), [&](const batches::Batch& batch) { return batch.name == name; });
}

void run_batch_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> cases = options.cases;
  if (cases.empty())
    cases = options.quick ? std::vector<std::string>{"U", "S", "M", "P", "C", "W2", "R", "heap"}
                          : std::vector<std::string>{"U",    "D",    "S",      "M",    "M2",   "P",       "C",
                                                     "W1",   "W2",   "W3",     "R",    "X",    "lattice", "scaffold",
                                                     "heap", "rods", "graded", "diag", "city", "voxel",   "pareto"};
  std::vector<std::size_t> sizes = options.sizes;
  if (sizes.empty())
    sizes = options.quick ? std::vector<std::size_t>{100, 1000, 100000}
                          : std::vector<std::size_t>{10, 32, 100, 1000, 10000, 100000, 1000000};
  // Smaller runs tell what larger ones will take.
  std::sort(sizes.begin(), sizes.end());

  std::vector<PeerConfig> peers = choose_peers(make_peers(options.threads), options.peers);
  Ours ours(make_detector);
  BatchContest contest({"batch", options, ours, peers, report, progress});
  for (const std::size_t n : sizes)
    for (const std::string& name : cases) contest.run(name, n);
}

}  // namespace boxstream::bench
