// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstddef>
#include <stdexcept>

#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>

namespace boxstream::detail {

/// Has an executor call `task(i)` for each i < `count`. Throws std::logic_error if it has not called each exactly once:
/// results are incomplete then.
inline void run_tasks(Executor& executor, std::size_t count, FunctionRef<void(std::size_t)> task) {
  std::atomic<std::size_t> left{count};
  executor.parallel_for(count, [&](std::size_t i) {
    if (i < count) task(i);
    left.fetch_sub(1, std::memory_order_acq_rel);
  });
  if (left.load(std::memory_order_acquire) != 0)
    throw std::logic_error("boxstream: an executor has not run each task once");
}

}  // namespace boxstream::detail
