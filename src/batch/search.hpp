// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "base/keys.hpp"
#include "batch/cuts/wide_tree.hpp"
#include "batch/parallel/team.hpp"
#include "batch/records/delivery.hpp"
#include "batch/records/pair_buffer.hpp"

namespace boxstream::detail {

/// The input of one search, and its map of keys.
template <class S>
struct Search {
  Input<S> input;
  KeyMap<S> keys;

  explicit Search(const Input<S>& in) : input(in), keys(key_map(in)) {
    keys.fit(input.a, input.self ? Span<const BasicAabb<S>>() : input.b);
  }

  PairOrder order() const { return input.self ? PairOrder::smaller_first : PairOrder::first_set_first; }

  SweepContext make_sweep(Arena& arena, PairBuffer& buffer) const {
    SweepContext sweep{arena, buffer, {keys.kind(0), keys.kind(1), keys.kind(2)}, order()};
    if constexpr (sizeof(S) == 8) {
      // By them sweeps decide on closed boxes alone.
      const bool is_closed = input.faces == Faces::closed;
      sweep.originals = {&keys.lossy(), is_closed ? input.a.data() : nullptr, is_closed ? input.b.data() : nullptr};
    }
    return sweep;
  }

  WideTree make_tree(Arena& arena, PairBuffer& buffer, Stats& stats, Team* team = nullptr,
                     const FixedPlan* by_hand = nullptr) const {
    return WideTree(input.boxes(), make_sweep(arena, buffer), stats, team, by_hand);
  }

 private:
  static KeyMap<S> key_map(const Input<S>& in) {
    if constexpr (sizeof(S) == 4)
      return KeyMap<S>(in.faces, in.float_kind);
    else
      return KeyMap<S>(in.faces);
  }
};

}  // namespace boxstream::detail
