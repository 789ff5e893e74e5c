// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <boxstream/detector.hpp>
#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "base/thresholds.hpp"
#include "batch/hybrid/hybrid_tree.hpp"
#include "batch/leaf/sweep.hpp"
#include "batch/parallel/ordered_tasks.hpp"
#include "batch/records/delivery.hpp"
#include "batch/records/records_of.hpp"
#include "batch/records/source.hpp"
#include "batch/search.hpp"

namespace boxstream::detail {

template <class S>
bool do_tasks(const Search<S>& search, const HybridTree::Task* first, const HybridRules& rules, Arena& arena,
              const Parallel& parallel, PairSink sink, Stats& stats) {
  std::size_t count = 0;
  for (const HybridTree::Task* task = first; task != nullptr; task = task->next) ++count;
  auto* const tasks = arena.allocate<const HybridTree::Task*>(count);
  for (std::size_t i = 0; i < count; ++i, first = first->next) tasks[i] = first;
  OrderedTasks in_order(parallel, sink, stats);
  return count == 0 || in_order.run(count, [&](std::size_t i, Arena& own, PairSink take, Stats& work) {
    DeliveringBuffer<S> buffer(search.input, take);
    SweepContext sweep = search.make_sweep(own, buffer);
    HybridTree tree(sweep, work, rules);
    const bool complete = tree.do_task(*tasks[i]) && buffer.flush();
    work.tests += sweep.tests;
    return complete;
  });
}

/// A search by the paper's tree alone. With `parallel`, if it is not null, the upper part of the tree is cut on the
/// calling thread, and what is below it are tasks. False when the sink refused.
template <class S>
bool search_hybrid(const Input<S>& input, Arena& arena, const Parallel* parallel, PairSink sink, Stats& stats) {
  const Arena::Frame frame(arena);
  DeliveringBuffer<S> buffer(input, sink);
  const Search<S> search(input);
  SweepContext sweep = search.make_sweep(arena, buffer);
  const Span<Record> a = records_of(BoxSource<S>(input.a, search.keys), arena);
  const Span<Record> b = input.self ? a : records_of(BoxSource<S>(input.b, search.keys), arena);
  stats.invalid += input.boxes() - a.size() - (input.self ? 0 : b.size());
  HybridRules rules;
  rules.scans = input.cutoff == 0 ? HybridRules::Scans::sampled : HybridRules::Scans::below_cutoff;
  rules.cutoff = input.cutoff;
  if (input.cutoff == 0) choose_axes(a, b, rules);
  HybridTree tree(sweep, stats, rules);
  if (parallel != nullptr) tree.collect_tasks(input.boxes() / (thresholds.subtrees_of_thread * parallel->threads) + 1);
  const bool complete = (input.self ? tree.join_self(a) : tree.join_cross(a, b)) && buffer.flush();
  stats.tests += sweep.tests;
  stats.pairs += buffer.delivered();
  return parallel == nullptr ? complete : do_tasks(search, tree.tasks(), rules, arena, *parallel, sink, stats);
}

}  // namespace boxstream::detail
