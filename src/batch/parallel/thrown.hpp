// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <exception>
#include <mutex>
#include <utility>

#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>

#include "batch/parallel/run_tasks.hpp"

namespace boxstream::detail {

/// What tasks of one job threw, until the job rethrows it: of several exceptions that of the first task, as if one
/// thread had done them in order. It is moved out when it is rethrown, and destroyed with the job otherwise: an
/// exception may hold a caller's objects, which must not outlive their use.
class Thrown {
 public:
  /// In the catch clause of a task, on any thread.
  void keep(std::size_t task) noexcept {
    std::exception_ptr dropped = std::current_exception();  // it may run a caller's code, so no lock is held there
    const std::lock_guard lock(mutex_);
    if (error_ && task_ <= task) return;
    std::swap(error_, dropped);
    task_ = task;
  }

  /// When all tasks have returned: throws it, if there is one.
  void rethrow() {
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
  std::size_t task_ = 0;
};

/// As run_tasks, for tasks that may throw.
inline void run_parts(Executor& executor, std::size_t count, FunctionRef<void(std::size_t)> part) {
  Thrown thrown;
  run_tasks(executor, count, [&](std::size_t i) {
    try {
      part(i);
    } catch (...) {
      thrown.keep(i);
    }
  });
  thrown.rethrow();
}

}  // namespace boxstream::detail
