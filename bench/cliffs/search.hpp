// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "cliffs/keeper.hpp"

namespace boxstream::bench {

/// One call after one history at one size. Nanoseconds of a call.
struct CliffPoint {
  std::size_t n = 0, things = 0;  ///< boxes, and with them pairs
  double ours = 0;
  double peer = 0;  ///< 0: there is none
  bool equal = true;

  double ratio() const { return peer > 0 ? peer / ours : 1e9; }
};

/// Medians of interleaved repetitions; `makes` is how often all is made anew.
CliffPoint measure(const CliffCall& call, History history, std::size_t n, int makes);

/// Where the time per box and pair jumps, or is more than a peer takes.
struct Cliff {
  std::string call, history;
  std::size_t from = 0, to = 0;  ///< neighbours, or the first and the last of neighbours that are below the peer
  std::size_t worst = 0;         ///< of the latter: where
  double jump = 0, below = 0;    ///< one of them
};

/// What is said of one call.
struct CliffRow {
  std::string owner, name, description;
  std::size_t sizes = 0;
  double largest_jump = 0;  ///< of the time per box and pair, confirmed where it is reported
  std::size_t jump_from = 0, jump_to = 0;
  std::string jump_history{};
  double least = 1e9;  ///< of the peer's time over ours
  std::size_t least_at = 0;
  std::string least_history{};
  std::size_t below = 0;            ///< points at which the peer is faster
  std::vector<CliffPoint> fresh{};  ///< if there is a peer
  bool equal = true;
  std::vector<Cliff> cliffs{};
};

/// Sizes one by one to `by_one`, then by `step` to `most`.
std::vector<std::size_t> cliff_sizes(std::size_t by_one, double step, std::size_t most);

/// Each place is measured again before it is reported.
CliffRow search_cliffs(const CliffCall& call, const std::vector<std::size_t>& sizes, double most_jump,
                       const std::function<void(const std::string&)>& show);

}  // namespace boxstream::bench
