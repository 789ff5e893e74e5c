// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "suites.hpp"

namespace boxstream::bench {

/// How somebody does what a case asks for.
struct Way {
  std::string name, family;     ///< of a family only the fastest is shown, but all that are wrong
  std::function<void()> run;    ///< empty: does not run, for the reason in `skipped`
  std::function<bool()> equal;  ///< is the result that of ours? Called after `run`; empty: it is another one
  bool yardstick = false;       ///< no rival: other work, or the same at another price
  std::string skipped;
};

/// Times ours against those of the ways that the options ask for, in turn, and reports a row for each: `row` with what
/// was measured.
void race(const Row& row, const std::function<void()>& ours, std::vector<Way> ways, const Options& options,
          Report& report, Progress& progress);

}  // namespace boxstream::bench
