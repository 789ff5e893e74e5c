// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include <boxstream/detector.hpp>

#include "base/arena.hpp"
#include "base/thresholds.hpp"
#include "batch/front/classes.hpp"
#include "batch/front/two_sets.hpp"
#include "batch/hybrid_search.hpp"
#include "batch/records/columns.hpp"
#include "batch/records/delivery.hpp"
#include "batch/search.hpp"
#include "batch/search_team.hpp"

namespace boxstream::detail {

template <class S>
bool is_small(const Input<S>& input) {
  return input.method == Method::planned && input.self && input.a.size() <= thresholds.most_small;
}

/// Few boxes, all with all: nothing is set up before. Pairs have the caller's indices; the buffer may be that of many
/// searches.
template <class S>
void search_small(const Input<S>& input, PairBuffer& buffer, Stats& stats) {
  const std::size_t size = input.a.size();
  const std::size_t valid = compare_small(input.a.data(), size, input.faces, input.first_a, buffer);
  stats.records += valid;
  stats.invalid += size - valid;
  stats.cells += valid < 2 ? 0 : 1;
  stats.tests += size * (size - 1) / 2;
}

/// One that is alone.
template <class S>
void search_small(const Input<S>& input, PairSink sink, Stats& stats) {
  DeliveringBuffer<S> buffer(input, sink);
  search_small(input, buffer, stats);
  buffer.flush();
  stats.pairs += buffer.delivered();
}

/// In the arena, for it is large; null where filters are none, or save nothing.
template <class S>
const Classes* worthwhile_classes(const Input<S>& input, Arena& arena) {
  if (input.filters_a.empty() && input.filters_b.empty()) return nullptr;
  const auto* classes = new (arena.allocate<Classes>(1))
      Classes(input.filters_a, input.a.size(), input.filters_b, input.b.size(), input.self, arena);
  return classes->are_worth_it() ? classes : nullptr;
}

/// More boxes, and two sets; by more than one thread if `parallel` is not null. False when the sink refused.
template <class S>
bool search_large(const Input<S>& input, Arena& arena, const Parallel* parallel, PairSink sink, Stats& stats) {
  if (input.method == Method::hybrid) return search_hybrid(input, arena, parallel, sink, stats);
  const Arena::Frame frame(arena);
  const Classes* const classes = worthwhile_classes(input, arena);
  Input<S> asked = input;
  if (classes != nullptr && !classes->need_filters()) asked.filters_a = asked.filters_b = {};
  DeliveringBuffer<S> buffer(asked, sink);
  const Search<S> search(asked);
  std::optional<SearchTeam<S>> team;
  if (parallel != nullptr) team.emplace(search, *parallel, sink, stats);
  WideTree tree = search.make_tree(arena, buffer, stats, team ? &*team : nullptr);
  const BoxSource<S> a(input.a, search.keys), b(input.b, search.keys);
  CrossSearch two_sets{
      arena, buffer, stats, {search.keys.kind(0), search.keys.kind(1), search.keys.kind(2)}, input.faces};
  bool complete = classes != nullptr ? classes->join(a, b, tree, two_sets)
                  : input.self       ? tree.join_self(a, {})
                                     : two_sets.join(a, b, tree);
  complete = complete && buffer.flush();
  stats.pairs += buffer.delivered();
  return complete;
}

}  // namespace boxstream::detail
