// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

#include "format/experiment.hpp"
#include "format/results.hpp"

namespace boxstream::report {

/// Facts of a run, which tables carry in lines that begin with '#'.
struct Origin {
  std::string command;  ///< that makes the table again
  int repeats = 0;
  double others = NAN;  ///< processors kept busy by other processes meanwhile
};

/// DIRECTORY/ID.csv, and DIRECTORY/ID.curves.csv if there are curves. Throws std::runtime_error if they cannot be
/// written; nothing is left half written.
void write_results(const std::string& directory, const Experiment& experiment, const Results& results,
                   const Origin& origin);

}  // namespace boxstream::report
