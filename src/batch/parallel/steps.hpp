// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cassert>
#include <cstddef>
#include <new>
#include <thread>

#include <boxstream/function_ref.hpp>
#include <boxstream/span.hpp>

#include "base/even_parts.hpp"
#include "batch/parallel/thrown.hpp"

namespace boxstream::detail {

/// Work in steps, each of many items, by the same workers: waking threads for each step would take as long as the work
/// of a small search. A worker waits only for items that others are working on, so any number of workers will do, and
/// they need not run at the same time.
///
/// Items of the last step are begun in their order. In the others each worker begins with a share that is its own in
/// all steps, and in all searches of the same size: what it has written then is in the caches of its processor. To
/// write what another processor has in its caches takes several times as long.
class Steps {
 public:
  static constexpr std::size_t most = 3;

  /// Whether an item of a step has been taken.
  using Taken = std::atomic<bool>;

  /// `begin(step)` is called by one worker when all items of the steps before are done, and returns how many items the
  /// step has; none: this was the last. `work(step, item)` must not throw. `taken` is scratch, for all items of all
  /// steps but the last.
  Steps(std::size_t workers, Span<Taken> taken, FunctionRef<std::size_t(std::size_t)> begin,
        FunctionRef<void(std::size_t, std::size_t)> work)
      : workers_(workers), taken_(taken), begin_(begin), work_(work) {
    for (Taken& each : taken_) new (&each) Taken(false);
    open(0);
  }

  /// What each worker does, of that number.
  void work(std::size_t worker) {
    assert(worker < workers_);
    std::size_t looked_at = 0;  // items of this step
    for (std::size_t s, last = most; (s = open_.load(std::memory_order_acquire)) != most; last = s) {
      Step& step = steps_[s];
      if (s != last) looked_at = 0;
      const std::size_t item = next_item(step, s, worker, looked_at);
      if (item < step.items) {
        work_(s, item);
        if (step.left.fetch_sub(1, std::memory_order_acq_rel) == 1) open(s + 1);
      } else if (s + 1 == most) {
        return;
      } else {
        while (open_.load(std::memory_order_acquire) == s) std::this_thread::yield();
      }
    }
  }

  /// After all have returned: throws what a beginning threw.
  void rethrow() { thrown_.rethrow(); }

 private:
  struct alignas(64) Step {
    std::size_t items = 0;
    std::size_t first = 0;  // of its items in taken_
    std::atomic<std::size_t> next{0};
    alignas(64) std::atomic<std::size_t> left{0};
  };

  /// An item that is now this worker's, or any number from step.items on.
  std::size_t next_item(Step& step, std::size_t s, std::size_t worker, std::size_t& looked_at) {
    if (s + 1 == most) return step.next.fetch_add(1, std::memory_order_relaxed);
    const std::size_t own = begin_of_part(step.items, worker, workers_);
    while (looked_at < step.items) {
      const std::size_t item = (own + looked_at++) % step.items;
      Taken& taken = taken_[step.first + item];
      if (!taken.load(std::memory_order_relaxed) && !taken.exchange(true, std::memory_order_relaxed)) return item;
    }
    return step.items;
  }

  void open(std::size_t s) {
    if (s != most) {
      try {
        steps_[s].items = begin_(s);
        if (s != 0) steps_[s].first = steps_[s - 1].first + steps_[s - 1].items;
      } catch (...) {
        thrown_.keep(s);
      }
      steps_[s].left.store(steps_[s].items, std::memory_order_relaxed);
      if (steps_[s].items == 0) s = most;
    }
    open_.store(s, std::memory_order_release);
  }

  std::size_t workers_;
  Span<Taken> taken_;
  FunctionRef<std::size_t(std::size_t)> begin_;
  FunctionRef<void(std::size_t, std::size_t)> work_;
  Step steps_[most];
  std::atomic<std::size_t> open_{most};
  Thrown thrown_;
};

}  // namespace boxstream::detail
