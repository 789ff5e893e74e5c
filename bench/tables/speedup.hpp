// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "tables/plot.hpp"

namespace boxstream::bench {

/// How many times as fast as on one thread, by Amdahl's law, where that share is done by one thread.
constexpr double amdahl(double share, double threads) {
  return 1 / (share + (1 - share) / threads);
}

/// Speed against threads up to 64: of each n of a case of suite scaling a line by Amdahl's law, and a line through what
/// was measured. Throws as read_plot does.
Plot read_speedup(const std::string& json_path, const std::string& case_name);

}  // namespace boxstream::bench
