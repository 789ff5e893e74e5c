// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>

#include <boxstream/function_ref.hpp>

namespace boxstream::detail {

/// Work in steps, each of many items, by the same workers: to wake threads for each step would take as long as the work
/// of a small search. A worker waits only for items that others are at work on, so it does not matter how many workers
/// there are in the end, nor whether they run at the same time.
class Steps {
 public:
  static constexpr std::size_t most = 3;

  /// `begin(step)` is called by one worker when all items of the steps before are done, and returns how many items the
  /// step has; none: this was the last. `work(step, item)` must not throw.
  Steps(FunctionRef<std::size_t(std::size_t)> begin, FunctionRef<void(std::size_t, std::size_t)> work)
      : begin_(begin), work_(work) {
    open(0);
  }

  /// What each worker does.
  void work() {
    for (std::size_t s; (s = open_.load(std::memory_order_acquire)) != most;) {
      Step& step = steps_[s];
      const std::size_t item = step.next.fetch_add(1, std::memory_order_relaxed);
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
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  struct alignas(64) Step {
    std::size_t items = 0;
    std::atomic<std::size_t> next{0};
    alignas(64) std::atomic<std::size_t> left{0};
  };

  void open(std::size_t s) {
    if (s != most) {
      try {
        steps_[s].items = begin_(s);
      } catch (...) {
        error_ = std::current_exception();
      }
      steps_[s].left.store(steps_[s].items, std::memory_order_relaxed);
      if (steps_[s].items == 0) s = most;
    }
    open_.store(s, std::memory_order_release);
  }

  FunctionRef<std::size_t(std::size_t)> begin_;
  FunctionRef<void(std::size_t, std::size_t)> work_;
  Step steps_[most];
  std::atomic<std::size_t> open_{most};
  std::exception_ptr error_;
};

}  // namespace boxstream::detail
