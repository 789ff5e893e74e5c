// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>

#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "batch/parallel/run_tasks.hpp"
#include "batch/parallel/task_pool.hpp"
#include "batch/parallel/thrown.hpp"

namespace boxstream::detail {

/// Which threads may call the sink.
enum class SinkThread { calling, any_one };

/// What is needed to search by more than one thread, by up to `threads` of them, wherever there are `least_boxes`.
/// `most_held` bounds how many pairs tasks hold back together.
struct Parallel {
  Executor& executor;
  std::size_t threads;
  std::size_t least_boxes;
  TaskPool& pool;
  std::size_t most_held;
  SinkThread sink_thread;
};

/// Tasks of an Executor whose pairs come in the order of the tasks.
///
/// The first task that has not delivered all its pairs delivers directly; the others hold their pairs until they are
/// the first. No task waits, so the executor may run them one after the other, in any order. A task that finds no room
/// to hold more stops; later it is repeated on the calling thread, without the pairs it held. A task that finds no room
/// at its start is left for another round.
class OrderedTasks {
 public:
  /// Finds the pairs of task `i`, in the same order each time, and counts its work. False when the sink refused.
  using Search = FunctionRef<bool(std::size_t i, Arena& arena, PairSink sink, Stats& stats)>;

  /// Pairs and work are counted in `stats`.
  OrderedTasks(const Parallel& parallel, PairSink sink, Stats& stats)
      : executor_(parallel.executor),
        threads_(parallel.threads),
        pool_(parallel.pool),
        most_held_(parallel.most_held),
        sink_(sink),
        any_thread_delivers_(parallel.sink_thread == SinkThread::any_one),
        stats_(stats) {}

  std::size_t threads() const { return threads_; }

  void begin(std::size_t count) {
    pool_.prepare(count, std::min(count, threads_), most_held_);
    turn_ = 0;
    stopping_ = false;
    delivering_ = false;
  }

  /// Does task `i`, unless it is to be left for later. Does not throw.
  void work_on(std::size_t i, Search search) {
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
      const bool complete = search_with_lease(i, search, take, stats);
      task.stats = stats;
      if (!complete) return;
      {
        const std::lock_guard lock(mutex_);
        task.done = true;
      }
      deliver_done(deliverer);
    } catch (...) {
      thrown_.keep(i);
      stopping_ = true;
    }
  }

  /// On the calling thread, when all tasks have been worked on once: whatever is left. Throws what a task threw. False
  /// when the sink refused.
  bool finish(Search search) {
    for (;;) {
      thrown_.rethrow();
      if (stopping_ || !deliver_done(true)) return false;
      if (turn_ == pool_.tasks()) return true;
      // The round ended for lack of room, or because only the calling thread may deliver and it took no part.
      if (!finish_here(pool_.task(turn_), turn_, search)) return false;
      ++turn_;
      if (!deliver_done(true)) return false;
      const std::size_t begin = turn_;
      run_tasks(executor_, pool_.tasks() - begin, [&](std::size_t i) { work_on(begin + i, search); });
    }
  }

  /// All of it.
  bool run(std::size_t count, Search search) {
    begin(count);
    run_tasks(executor_, count, [&](std::size_t i) { work_on(i, search); });
    return finish(search);
  }

 private:
  using Task = TaskPool::Task;

  bool may_deliver() const { return any_thread_delivers_ || std::this_thread::get_id() == calling_thread_; }

  bool search_with_lease(std::size_t i, Search search, PairSink sink, Stats& stats) {
    TaskPool::Lease lease(pool_);
    return search(i, lease.arena(), sink, stats);
  }

  /// Does the rest of the task whose turn it is.
  bool finish_here(Task& task, std::size_t i, Search search) {
    std::uint64_t delivered = task.held.size();
    if (!deliver_held(task)) return false;
    task.started = true;
    const auto deliver_new = [&](Span<const Pair> pairs) {
      const auto old = static_cast<std::size_t>(std::min<std::uint64_t>(delivered, pairs.size()));
      delivered -= old;
      return old == pairs.size() || deliver(pairs.subspan(old, pairs.size() - old));
    };
    Stats work;
    const bool complete = search_with_lease(i, search, deliver_new, work);
    add_work(work);
    return complete;
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
    stats_.invalid += part.invalid;
    stats_.nodes += part.nodes;
    stats_.cells += part.cells;
    stats_.records += part.records;
    stats_.tests += part.tests;
    stats_.over_budget += part.over_budget;
  }

  Executor& executor_;
  std::size_t threads_;
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
  Thrown thrown_;  // the pool outlives the search
};

}  // namespace boxstream::detail
