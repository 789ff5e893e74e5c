// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/stats.hpp>

#include "search/arena.hpp"
#include "search/delivery.hpp"
#include "search/keys.hpp"
#include "search/pair_buffer.hpp"
#include "search/team.hpp"
#include "search/tree.hpp"

namespace boxstream::detail {

/// One search, as its parts see it.
template <class S>
struct Search {
  Input<S> input;
  bool self;
  KeyMap<S> keys;

  Search(const Input<S>& in, bool is_self) : input(in), self(is_self) {
    keys.fit(input.a, self ? Span<const BasicAabb<S>>() : input.b);
  }

  Tree make_tree(Arena& arena, PairBuffer& buffer, Stats& stats, Team* team = nullptr) const {
    const auto order = self ? PairOrder::smaller_first : PairOrder::first_set_first;
    return Tree(input.a.size() + (self ? 0 : input.b.size()), arena, buffer, {keys.kind(0), keys.kind(1), keys.kind(2)},
                order, stats, team);
  }
};

}  // namespace boxstream::detail
