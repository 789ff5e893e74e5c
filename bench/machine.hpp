// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::bench {

/// Where and how the numbers of a run were made.
struct Machine {
  std::string cpu;
  unsigned hardware_threads;
  std::string compiler;
  std::string flags;
  std::string peer_flags;
  std::string simd;
  std::string date;  ///< UTC, ISO 8601
  std::string version;
  double load;         ///< average number of runnable threads over the last minute; 0 is a quiet machine
  std::string commit;  ///< of the sources, as the environment's BOXSTREAM_COMMIT says; may be empty
};

Machine describe_machine();

}  // namespace boxstream::bench
