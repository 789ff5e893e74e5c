// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tables/plot.hpp"
#include "tables/report.hpp"

namespace boxstream::bench {

/// How many times as fast as on one thread, by Amdahl's law, where that share is done by one thread.
constexpr double amdahl(double share, double threads) {
  return 1 / (share + (1 - share) / threads);
}

/// Speed against threads up to 64: of each n of a case of suite scaling a line by Amdahl's law, and a line through what
/// was measured. Throws as read_plot does.
Plot read_speedup(const std::string& json_path, const std::string& case_name);

/// The target of one row: ours at least `factor` times as fast as the peer.
struct Target {
  double factor;
  const Row* row;

  bool met() const { return row->ratio() >= factor; }
};

/// For each case with a target, the row with the smallest ratio. Skipped peers do not count.
std::vector<Target> check_targets(const std::vector<Row>& rows);

}  // namespace boxstream::bench
