// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "batch/cuts/plan.hpp"
#include "batch/cuts/wide_tree.hpp"
#include "batch/records/delivery.hpp"
#include "batch/records/source.hpp"
#include "batch/search.hpp"

namespace boxstream::detail {

/// Finds the pairs within a set, or between two, as planned by hand, on the calling thread. For tests, and for
/// measurements that look for the best plan.
template <class S>
Stats search_by_plan(const FixedPlan& plan, const Input<S>& input, Arena& arena, PairSink sink) {
  Stats stats;
  {
    const Arena::Frame frame(arena);
    DeliveringBuffer<S> buffer(input, sink);
    const Search<S> search(input);
    WideTree tree = search.make_tree(arena, buffer, stats, nullptr, &plan);
    const BoxSource<S> a(input.a, search.keys), b(input.b, search.keys);
    if (input.self ? tree.join_self(a, {}) : tree.join_cross(a, b, {})) buffer.flush();
  }
  return stats;
}

}  // namespace boxstream::detail
