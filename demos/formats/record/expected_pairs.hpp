// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/pair.hpp>
#include <cstdint>
#include <vector>

#include "formats/record/op.hpp"
#include "formats/record/pair_limit.hpp"

namespace boxstream::record {

/// What a broad-phase has to answer to a stream of calls, found by a sort along one axis alone.
///
/// A pair is expected at a batch when both boxes are valid and overlap then, and its filters accept, or did at the
/// first of the batches since which it has been expected: filters are called when a pair begins.
class ExpectedPairs {
 public:
  /// Takes in a call; queries and batches change nothing.
  void apply(const Op& op);

  /// The pairs expected at a batch, sorted. To be called at each batch, once. Throws RecordError as soon as there are
  /// more than `most`.
  const std::vector<Pair>& pairs(std::uint64_t most = usual_most_pairs);
  /// The proxies expected of a box query, sorted.
  std::vector<std::uint32_t> in_box(const Aabb64& box) const;

  /// Whether both proxies live, and their boxes are valid and overlap.
  bool overlap(Pair pair) const;
  bool overlap(std::uint32_t id, const Aabb64& box) const;

  bool is_alive(std::uint32_t id) const { return id < proxies_.size() && proxies_[id].alive; }
  const Aabb64& box(std::uint32_t id) const { return proxies_[id].box; }

 private:
  struct Proxy {
    Aabb64 box;
    std::int32_t group;
    std::int32_t mask;
    bool alive;
  };

  bool accepts(Pair pair) const;

  std::vector<Proxy> proxies_;        // by id
  std::vector<std::uint32_t> order_;  // of the living with valid boxes
  std::vector<Pair> expected_;
  std::vector<Pair> former_;
};

}  // namespace boxstream::record
