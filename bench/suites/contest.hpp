// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "peers/ours.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {

/// The contestants of a suite, and where its rows go. All but the name is borrowed.
struct Contest {
  std::string suite;  ///< in rows
  const Options& options;
  Ours& ours;
  std::vector<PeerConfig>& peers;
  Report& report;
  Progress& progress;

  double limit_ms() const { return 1000 * options.limit_seconds; }
  Row row_of(const std::string& case_name, std::size_t n, const std::string& peer) const {
    return {.suite = suite, .case_name = case_name, .n = n, .peer = peer};
  }
  /// The configurations of each family, which are adjacent.
  std::vector<Span<PeerConfig>> families() const {
    std::vector<Span<PeerConfig>> all;
    for (std::size_t first = 0, last; first < peers.size(); first = last) {
      for (last = first; last < peers.size() && peers[last].family == peers[first].family;) ++last;
      all.emplace_back(peers.data() + first, last - first);
    }
    return all;
  }
};

}  // namespace boxstream::bench
