// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>

#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>

#include "batch/parallel/task_pool.hpp"
#include "batch/parallel/team.hpp"
#include "batch/search.hpp"

namespace boxstream::detail {

/// Which threads may call the sink.
enum class SinkThread { calling, any_one };

/// The team of one search: children of a node as tasks of an Executor.
///
/// The first task that has not delivered all its pairs delivers directly; the others hold their pairs until they are
/// the first. No task waits, so the executor may run them one after the other, in any order. A task that finds no room
/// to hold more stops; later it is repeated on the calling thread, without the pairs it held. A task that finds no room
/// at its start is left for another round.
template <class S>
class SearchTeam final : public Team {
 public:
  SearchTeam(const Search<S>& search, Executor& executor, TaskPool& pool, std::size_t most_held, PairSink sink,
             SinkThread sink_thread, Stats& stats)
      : search_(search),
        executor_(executor),
        pool_(pool),
        most_held_(most_held),
        sink_(sink),
        any_thread_delivers_(sink_thread == SinkThread::any_one),
        stats_(stats) {}

  std::size_t threads() const override { return executor_.concurrency(); }

  void run_parts(std::size_t count, FunctionRef<void(std::size_t)> part) override {
    executor_.parallel_for(count, part);
  }

  void begin_children(std::size_t count) override {
    pool_.prepare(count, threads(), most_held_);
    turn_ = 0;
    stopping_ = false;
    delivering_ = false;
  }

  void work_on_child(std::size_t i, FunctionRef<bool(Tree&, std::size_t)> child) override {
    Task& task = pool_.task(i);
    if (task.started || stopping_.load(std::memory_order_relaxed)) return;
    const bool deliverer = may_deliver();
    const auto is_its_turn = [&] { return deliverer && turn_.load(std::memory_order_acquire) == i; };
    if (!is_its_turn() && !pool_.room().has_room()) return;
    task.started = true;
    try {
      const auto take = [&](Span<const Pair> pairs) {
        if (stopping_.load(std::memory_order_relaxed)) return false;
        if (is_its_turn()) return deliver_held(task) && deliver(pairs);
        return task.held.append(pairs, pool_.room());
      };
      Stats stats;
      const bool complete = search(i, child, take, 0, stats);
      task.stats = stats;
      if (!complete) return;
      {
        const std::lock_guard lock(mutex_);
        task.done = true;
      }
      deliver_done(deliverer);
    } catch (...) {
      task.error = std::current_exception();
      stopping_ = true;
    }
  }

  bool finish_children(FunctionRef<bool(Tree&, std::size_t)> child) override {
    for (;;) {
      for (std::size_t i = 0; i < pool_.tasks(); ++i)
        if (pool_.task(i).error) std::rethrow_exception(pool_.task(i).error);
      if (stopping_ || !deliver_done(true)) return false;
      if (turn_ == pool_.tasks()) return true;
      // The round ended for lack of room, or because only the calling thread may deliver and it took no part.
      if (!finish_here(pool_.task(turn_), turn_, child)) return false;
      ++turn_;
      if (!deliver_done(true)) return false;
      const std::size_t begin = turn_;
      executor_.parallel_for(pool_.tasks() - begin, [&](std::size_t i) { work_on_child(begin + i, child); });
    }
  }

 private:
  using Task = TaskPool::Task;

  bool may_deliver() const { return any_thread_delivers_ || std::this_thread::get_id() == calling_thread_; }

  /// Does a child with a tree of its own, without the first `skipped` pairs.
  bool search(std::size_t i, FunctionRef<bool(Tree&, std::size_t)> child, PairSink sink, std::uint64_t skipped,
              Stats& stats) {
    TaskPool::Lease lease(pool_);
    DeliveringBuffer<S> buffer(search_.input, sink);
    buffer.skip(skipped);
    Tree tree = search_.make_tree(lease.arena(), buffer, stats);
    return child(tree, i) && buffer.flush();
  }

  /// Does what is left of the task whose turn it is.
  bool finish_here(Task& task, std::size_t i, FunctionRef<bool(Tree&, std::size_t)> child) {
    const std::uint64_t held = task.held.size();
    if (!deliver_held(task)) return false;
    task.started = true;
    return search(
        i, child, [&](Span<const Pair> pairs) { return deliver(pairs); }, held, stats_);
  }

  /// Delivers what tasks that are done hold, from the one whose turn it is up to the first that is not done. One thread
  /// at a time does it; others need not wait, for it looks again. False when the search is to stop.
  bool deliver_done(bool deliverer) {
    if (!deliverer) return true;
    std::unique_lock lock(mutex_);
    if (delivering_) return true;
    for (std::size_t i = turn_; i < pool_.tasks() && pool_.task(i).done; turn_.store(++i, std::memory_order_release)) {
      delivering_ = true;
      lock.unlock();
      if (!deliver_held(pool_.task(i))) return false;
      add_work(pool_.task(i).stats);
      lock.lock();
      delivering_ = false;
    }
    return true;
  }

  bool deliver_held(Task& task) {
    return task.held.pass_on([&](Span<const Pair> pairs) { return deliver(pairs); }, pool_.room());
  }

  bool deliver(Span<const Pair> pairs) {
    stats_.pairs += pairs.size();
    if (sink_(pairs)) return true;
    stopping_ = true;
    return false;
  }

  void add_work(const Stats& part) {
    stats_.nodes += part.nodes;
    stats_.cells += part.cells;
    stats_.records += part.records;
    stats_.tests += part.tests;
  }

  const Search<S>& search_;
  Executor& executor_;
  TaskPool& pool_;
  std::size_t most_held_;
  PairSink sink_;
  bool any_thread_delivers_;
  Stats& stats_;  // of those whose turn is over, and pairs: written by the thread that delivers
  const std::thread::id calling_thread_ = std::this_thread::get_id();

  std::mutex mutex_;
  std::atomic<std::size_t> turn_{0};
  std::atomic<bool> stopping_{false};
  bool delivering_ = false;
};

}  // namespace boxstream::detail
