// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <climits>
#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/executor.hpp>

namespace boxstream::mpi {

struct Options {
  /// Boxes of a rank that are sent at once. One round suffices by default; more take less memory for what is on its
  /// way.
  std::size_t boxes_in_round = INT_MAX;
  /// As in DetectorOptions.
  Executor* executor = nullptr;
};

/// What one search did on this rank.
struct Stats {
  std::uint64_t boxes = 0;          ///< given
  std::uint64_t invalid = 0;        ///< of these, boxes with a NaN or min > max, which pair with nothing
  std::uint64_t sampled = 0;        ///< of all ranks; every rank has them for a while
  std::uint64_t received = 0;       ///< boxes that touch the rank's part of space, from itself too: these it searches
  std::uint64_t tests = 0;          ///< box against box comparisons
  std::uint64_t pairs = 0;          ///< passed to the sink
  std::uint64_t bytes_sent = 0;     ///< to other ranks: the sample, boxes and ids
  std::uint64_t messages_sent = 0;  ///< that these are in
  /// The part of space that is this rank's; infinite where it has no end. min > max: none is left for it.
  Aabb64 part{{1, 1, 1}, {-1, -1, -1}};
};

}  // namespace boxstream::mpi
