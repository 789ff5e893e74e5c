// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "base/keys.hpp"
#include "batch/delivery.hpp"
#include "batch/pair_buffer.hpp"
#include "batch/parallel/team.hpp"
#include "batch/tree.hpp"

namespace boxstream::detail {

/// The input of one search, and its map of keys.
template <class S>
struct Search {
  Input<S> input;
  bool self;
  KeyMap<S> keys;

  Search(const Input<S>& in, bool is_self) : input(in), self(is_self) {
    keys.fit(input.a, self ? Span<const BasicAabb<S>>() : input.b);
  }

  Tree make_tree(Arena& arena, PairBuffer& buffer, Stats& stats, Team* team = nullptr,
                 const FixedPlan* by_hand = nullptr) const {
    const auto order = self ? PairOrder::smaller_first : PairOrder::first_set_first;
    return Tree(input.a.size() + (self ? 0 : input.b.size()), arena, buffer, {keys.kind(0), keys.kind(1), keys.kind(2)},
                order, stats, team, by_hand);
  }
};

}  // namespace boxstream::detail
