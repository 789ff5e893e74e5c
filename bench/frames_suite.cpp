// SPDX-License-Identifier: MIT
#include <algorithm>

#include "frame_contest.hpp"
#include "suites.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t largest_n_of_all_cases = 100000;

}  // namespace

bool is_frames_case(const std::string& name) {
  return is_motion_case(name);
}

void run_frames_suite(const Options& options, Report& report, Progress& progress) {
  std::vector<std::string> cases = options.cases;
  if (cases.empty()) {
    const std::vector<std::string> batches =
        options.quick ? std::vector<std::string>{"U", "P"} : std::vector<std::string>{"U", "M", "M2", "P", "C"};
    for (const std::string& batch : batches)
      for (const MotionName& motion : motions()) cases.push_back(batch + ':' + std::string(motion.name));
  }
  std::vector<std::size_t> sizes = options.sizes;
  if (sizes.empty())
    sizes = options.quick ? std::vector<std::size_t>{10000} : std::vector<std::size_t>{1000, 10000, 100000, 1000000};
  std::sort(sizes.begin(), sizes.end());

  std::vector<PeerConfig> peers = make_peers(options.threads);
  // Frames are timed on one thread; brute force is of no use to anybody here.
  std::erase_if(peers, [](const PeerConfig& peer) { return peer.threads > 1 || peer.family == "brute"; });
  // What it would cost to search anew in each frame, and know of no beginnings and ends.
  peers.insert(peers.begin(), PeerConfig{"detector", "detector", 1, "", make_detector(nullptr)});
  peers = choose_peers(std::move(peers), options.peers);
  Ours ours(make_world);
  FrameContest contest({"frames", options, ours, peers, report, progress});
  for (const std::size_t n : sizes)
    for (const std::string& name : cases) {
      // Each case takes minutes up there; who wants them all asks for them.
      if (n > largest_n_of_all_cases && options.cases.empty() && name.rfind("U:", 0) != 0) continue;
      contest.run(name, n);
    }
}

}  // namespace boxstream::bench
