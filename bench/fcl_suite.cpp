// SPDX-License-Identifier: MIT
#include <algorithm>

#include "batch_contest.hpp"
#include "frame_contest.hpp"
#include "suites.hpp"

namespace boxstream::bench {

bool is_fcl_case(const std::string& name) {
  return is_batch(name) || is_motion_case(name);
}

void run_fcl_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> cases = options.cases;
  if (cases.empty())
    cases = options.quick ? std::vector<std::string>{"U", "P", "U:brown"}
                          : std::vector<std::string>{"U",       "M",       "S",         "P",         "C",
                                                     "U:brown", "P:brown", "U:static5", "P:static5", "U:asleep"};
  std::vector<std::size_t> sizes = options.sizes;
  if (sizes.empty())
    sizes = options.quick ? std::vector<std::size_t>{1000} : std::vector<std::size_t>{1000, 10000, 100000};
  std::sort(sizes.begin(), sizes.end());

  std::vector<PeerConfig> peers = make_peers(options.threads);
  std::erase_if(peers, [](const PeerConfig& peer) { return peer.family.rfind("fcl-", 0) != 0; });
  peers = choose_peers(std::move(peers), options.peers);
  if (peers.empty()) return;
  Ours ours(make_world);
  BatchContest filling({"fcl", options, ours, peers, report, progress});
  FrameContest frames({"fcl", options, ours, peers, report, progress});
  for (const std::size_t n : sizes)
    for (const std::string& name : cases) {
      if (is_batch(name))
        filling.run(name, n);
      else
        frames.run(name, n);
    }
}

}  // namespace boxstream::bench
