// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>

#include "sanitized.hpp"

namespace boxstream::worlds_test {

/// Set BOXSTREAM_WHOLE_RUNS to have everything in full length: minutes instead of seconds.
inline bool whole_runs() {
  return std::getenv("BOXSTREAM_WHOLE_RUNS") != nullptr;
}

/// How much of something to do: all of it, what a test may take, or a sixth of that under sanitizers.
inline int size_of_run(int whole, int tested) {
  return whole_runs() ? whole : boxstream::tests::sanitized ? std::max(1, tested / 6) : tested;
}

}  // namespace boxstream::worlds_test
