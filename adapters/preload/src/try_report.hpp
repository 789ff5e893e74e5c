// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tally.hpp"

namespace boxstream::preload {

/// What all processes of a run said, and how the run went.
struct RunReport {
  std::vector<const Tally*> tallies;
  double seconds = 0;
  int exit_code = 0;
};

/// Reads the tallies that the processes of a run left in a folder.
std::vector<const Tally*> read_tallies(const std::string& folder);

/// Says in lines what was replaced; of a run with --check also what was compared. Returns whether something differed.
bool print_report(const RunReport& run, bool is_check);

/// A table of both runs: on the engine's own broad-phases, and on boxstream.
void print_comparison(const RunReport& own, const RunReport& ours);

}  // namespace boxstream::preload
