// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "ours.hpp"
#include "suites.hpp"

namespace boxstream::bench {

/// Who meets, by which rules, and where the rows go. All but the name is borrowed.
struct Contest {
  std::string suite;  ///< what rows say
  const Options& options;
  Ours& ours;
  std::vector<PeerConfig>& peers;
  Report& report;
  Progress& progress;
};

}  // namespace boxstream::bench
