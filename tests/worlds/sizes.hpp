// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdlib>

namespace worlds_tests {

/// Set BOXSTREAM_WHOLE_RUNS to have everything in full length: minutes instead of seconds.
inline bool whole_runs() {
  return std::getenv("BOXSTREAM_WHOLE_RUNS") != nullptr;
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool sanitized = true;
#else
inline constexpr bool sanitized = false;
#endif

/// How much of something to do: all of it, what a test may take, or a sixth of that under sanitizers.
inline int size_of_run(int whole, int tested) {
  return whole_runs() ? whole : sanitized ? std::max(1, tested / 6) : tested;
}

}  // namespace worlds_tests
