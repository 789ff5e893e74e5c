// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "report.hpp"

namespace boxstream::bench {

/// What the project wants of one row: ours at least `factor` times as fast as the peer.
struct Target {
  double factor;
  const Row* row;

  bool met() const { return row->ratio() >= factor; }
};

/// For each case with a target, the row that comes least close to it. Peers that were skipped hold nothing against us.
std::vector<Target> check_targets(const std::vector<Row>& rows);

}  // namespace boxstream::bench
