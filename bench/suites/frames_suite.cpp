// SPDX-License-Identifier: MIT
#include <algorithm>

#include "suites/frame_contest.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

namespace {

constexpr std::size_t largest_n_of_all_cases = 100000;

}  // namespace

bool is_frames_case(const std::string& name) {
  return is_motion_case(name);
}

namespace {

void run(const std::string& suite, const Options& options, const std::vector<std::string>& cases,
         const std::vector<std::size_t>& sizes, Report& report, Progress& progress) {
  std::vector<PeerConfig> peers = make_peers(options.threads);
  // Frames are timed on one thread; brute force is too slow for many boxes.
  std::erase_if(
      peers, [&](const PeerConfig& peer) { return peer.threads > 1 || (peer.family == "brute" && suite != "small"); });
  // A new search in each frame, which has no events.
  peers.insert(peers.begin(), PeerConfig{"detector", "detector", 1, "", make_detector(nullptr)});
  peers = choose_peers(std::move(peers), options.peers);
  Ours ours(make_world);
  FrameContest contest({suite, options, ours, peers, report, progress});
  for (const std::size_t n : sizes)
    for (const std::string& name : cases) {
      // Each case of this size takes minutes; the others run on request.
      if (n > largest_n_of_all_cases && options.cases.empty() && name.rfind("U:", 0) != 0) continue;
      contest.run(name, n);
    }
}

/// With each motion.
std::vector<std::string> cases_of(const std::vector<std::string>& batches) {
  std::vector<std::string> cases;
  for (const std::string& batch : batches)
    for (const MotionName& motion : motions()) cases.push_back(batch + ':' + std::string(motion.name));
  return cases;
}

}  // namespace

void run_frames_suite(const Options& options, Report& report, Progress& progress) {
  run("frames", options, options.cases_or(cases_of({"U", "P"}), cases_of({"U", "M", "M2", "P", "C"})),
      options.sizes_or({10000}, {1000, 10000, 100000, 1000000}), report, progress);
}

void run_small_suite(const Options& options, Report& report, Progress& progress) {
  run("small", options, options.cases_or(cases_of({"U"}), cases_of({"U", "C"})),
      options.sizes_or({10, 100}, {3, 10, 30, 100, 150, 300}), report, progress);
}

}  // namespace boxstream::bench
