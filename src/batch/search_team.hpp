// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <boxstream/detector.hpp>

#include "batch/parallel/ordered_tasks.hpp"
#include "batch/parallel/run_tasks.hpp"
#include "batch/parallel/team.hpp"
#include "batch/records/delivery.hpp"
#include "batch/search.hpp"

namespace boxstream::detail {

/// The team of one search: children of a node as tasks of an Executor, each with a tree of its own.
template <class S>
class SearchTeam final : public Team {
 public:
  SearchTeam(const Search<S>& search, const Parallel& parallel, PairSink sink, Stats& stats)
      : search_(search),
        executor_(parallel.executor),
        least_boxes_(parallel.least_boxes),
        tasks_(parallel, sink, stats) {}

  std::size_t threads() const override { return tasks_.threads(); }
  std::size_t least_boxes() const override { return least_boxes_; }

  void run_parts(std::size_t count, FunctionRef<void(std::size_t)> part) override { run_tasks(executor_, count, part); }

  void begin_children(std::size_t count) override { tasks_.begin(count); }

  void work_on_child(std::size_t i, FunctionRef<bool(WideTree&, std::size_t)> child) override {
    tasks_.work_on(i, with_tree(child));
  }

  bool finish_children(FunctionRef<bool(WideTree&, std::size_t)> child) override {
    return tasks_.finish(with_tree(child));
  }

 private:
  /// What a task does for a child.
  struct WithTree {
    const Search<S>& search;
    FunctionRef<bool(WideTree&, std::size_t)> child;
    bool operator()(std::size_t i, Arena& arena, PairSink sink, Stats& stats) const {
      DeliveringBuffer<S> buffer(search.input, sink);
      WideTree tree = search.make_tree(arena, buffer, stats);
      return child(tree, i) && buffer.flush();
    }
  };
  WithTree with_tree(FunctionRef<bool(WideTree&, std::size_t)> child) const { return {search_, child}; }

  const Search<S>& search_;
  Executor& executor_;
  std::size_t least_boxes_;
  OrderedTasks tasks_;
};

}  // namespace boxstream::detail
