// SPDX-License-Identifier: MIT
// What one process says of its run: a file that it maps, so that nothing is lost if it ends without a word.
#pragma once

#include <atomic>
#include <cstdint>

#include "members.hpp"

namespace boxstream::preload {

using Count = std::atomic<std::uint64_t>;

enum class Engine : std::uint8_t { bullet, fcl, count };

/// Of one engine in one process. Texts end with a zero; the first writer of a text wins.
struct EngineTally {
  char library[256];       ///< the file that was loaded
  char not_replaced[256];  ///< empty, or why all calls go to the engine
  Count calls[static_cast<int>(Kind::count)];
  Count nanoseconds;  ///< in all calls, with what they call back; calls within calls are not counted twice
  Count pairs;        ///< held after the last batch (Bullet), called back (FCL)
  Count most_pairs;
  Count sweeps;  ///< btAxisSweep3 made: not replaced

  Count checked_batches, checked_queries, checked_pairs;
  Count differing_batches, differing_queries, grazing_rays;
  char first_difference[1024];
};

struct Tally {
  static constexpr std::uint64_t magic_number = 0x31797274'7862ull;

  std::uint64_t magic;
  std::uint64_t process;
  char program[256];
  char unreached[4096];  ///< broad-phases that are not reached, one a line: unreached.hpp
  char idle[512];        ///< engines that are loaded, and of which nothing was called, one a line
  EngineTally engines[static_cast<int>(Engine::count)];
};

}  // namespace boxstream::preload
