// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "inputs/random.hpp"
#include "papers/hybrid/stream_node.hpp"

namespace boxstream::papers {

// Low ends are below +infinity since a box is never empty, so that [-infinity, +infinity) contains every point and the
// two need no values of their own.
constexpr std::int32_t minus_infinity = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t plus_infinity = std::numeric_limits<std::int32_t>::max();

/// Numbers of boxes below which Hybrid scans, by dimension: [2] is the first level of the tree, [1] the second. [0] is
/// never used. The paper uses one for both except in figure 7.
struct Cutoffs {
  std::size_t below[3] = {0, 1000, 1000};

  constexpr Cutoffs() = default;
  constexpr explicit Cutoffs(std::size_t both) : below{0, both, both} {}
  constexpr Cutoffs(std::size_t first_level, std::size_t second_level) : below{0, second_level, first_level} {}
};

struct HybridOptions {
  Cutoffs cutoffs;
  Level level;
  std::uint64_t seed = 1;  ///< of the random points in ApproxMedian; the pairs do not depend on it, their order does
};

/// What became of a node of the streamed tree.
enum class Node { streamed, cut_off, scanned };

/// Sees nothing. Others see the tree while it is walked: `enter` and `leave` enclose what happens below a node, and
/// `spanning` gives |Im| of the one entered last.
struct NoTrace {
  void enter(Node, int, std::size_t, std::size_t) {}
  void spanning(std::size_t) {}
  void leave() {}
};

/// Everything that is the same in all calls of one search.
template <class Problem, class Order, class Trace = NoTrace>
struct Search {
  Problem problem;
  Order order;
  HybridOptions options;
  Trace trace{};
  batches::Random random{options.seed};
};

}  // namespace boxstream::papers
