// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tables/report.hpp"

namespace boxstream::bench {

/// The target of one row: ours at least `factor` times as fast as the peer.
struct Target {
  double factor;
  const Row* row;

  bool met() const { return row->ratio() >= factor; }
};

/// For each case with a target, the row with the smallest ratio. Skipped peers do not count.
std::vector<Target> check_targets(const std::vector<Row>& rows);

}  // namespace boxstream::bench
