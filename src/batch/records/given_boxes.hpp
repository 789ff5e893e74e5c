// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <boxstream/box_span.hpp>
#include <boxstream/detector.hpp>

#include "base/arena.hpp"
#include "batch/records/delivery.hpp"

namespace boxstream::detail {

/// The sets of a search as callers give them. For a single set, `b` is the same as `a`.
struct GivenSets {
  BoxSpan a, b;
  bool self;
};

/// Throws std::length_error if there are too many boxes, and std::invalid_argument if rules are not for them.
void check(const GivenSets& sets, const PairRules& rules);

/// In which numbers sets are compared, exactly for each.
enum class Comparison {
  in_float,
  in_double,
  in_keys,  ///< integers, in place of the keys of floats
};

/// Throws std::invalid_argument if there is an integer that is in none of them.
Comparison comparison_of(const GivenSets& sets);

/// The boxes of one set in those numbers, the high ends raised by the tolerance of the rules: in the arena, unless they
/// are there already.
template <class S>
Span<const BasicAabb<S>> boxes_in(BoxSpan boxes, const PairRules& rules, Arena& arena);

template <class S>
Input<S> input_of(Comparison comparison, const GivenSets& sets, const PairRules& rules, Arena& arena) {
  const auto a = boxes_in<S>(sets.a, rules, arena);
  return {a,
          sets.self ? a : boxes_in<S>(sets.b, rules, arena),
          rules.filters,
          sets.self ? rules.filters : rules.filters_b,
          sets.self,
          0,
          0,
          {},
          0,
          rules.touching ? Faces::closed : Faces::open,
          rules.ids,
          sets.self ? rules.ids : rules.ids_b,
          comparison == Comparison::in_keys ? KeyKind::linear : KeyKind::float32};
}

/// Calls `search(input)`, with memory of the arena for as long as it takes.
template <class Search>
auto with_input(const GivenSets& sets, const PairRules& rules, Arena& arena, const Search& search) {
  check(sets, rules);
  const Arena::Frame frame(arena);
  const Comparison comparison = comparison_of(sets);
  return comparison == Comparison::in_double ? search(input_of<double>(comparison, sets, rules, arena))
                                             : search(input_of<float>(comparison, sets, rules, arena));
}

}  // namespace boxstream::detail
