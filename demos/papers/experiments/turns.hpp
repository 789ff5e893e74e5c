// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "papers/experiments/measure.hpp"

namespace boxstream::papers {

struct Contestant {
  std::string name;
  std::function<void(Found)> search;  ///< as for `measure`
};

/// Each in turn, `repeats` times over, so that what disturbs the machine for a while meets all of them. Medians, in the
/// same order. Throws std::runtime_error, naming who, when they do not find the same pairs.
std::vector<Measured> measure_in_turns(int repeats, const std::vector<Contestant>& contestants);

}  // namespace boxstream::papers
