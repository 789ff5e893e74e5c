// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stdexcept>

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <boxstream/executor.hpp>

namespace boxstream {

/// Runs parallel work on oneTBB. The calling thread takes part. One TbbExecutor may serve any number of Detectors and
/// Worlds, at the same time too; it must outlive them.
///
/// It starts no threads of its own: it uses oneTBB's, as many of them as oneTBB lends it. As that does not tell whether
/// they sleep, they are taken to.
class TbbExecutor final : public Executor {
 public:
  static constexpr int most_threads = 4096;

  /// At most `threads` threads, the calling one included; by default as many as oneTBB finds useful. oneTBB keeps a
  /// place for each, so std::invalid_argument unless they are 1 to 4096.
  explicit TbbExecutor(int threads = tbb::task_arena::automatic) : arena_(checked(threads)) { arena_.initialize(); }

  unsigned concurrency() const override { return static_cast<unsigned>(arena_.max_concurrency()); }

  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    // A shared counter, not oneTBB's ranges: results are passed on in the order of the tasks, so those that start in
    // that order have least to hold back.
    std::atomic<std::size_t> next{0};
    const auto work = [&](std::size_t) {
      for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) task(i);
    };
    const std::size_t workers = std::min<std::size_t>(count, concurrency());
    arena_.execute([&] { tbb::parallel_for(std::size_t{0}, workers, work, tbb::simple_partitioner()); });
  }

 private:
  static int checked(int threads) {
    if (threads == tbb::task_arena::automatic || (threads >= 1 && threads <= most_threads)) return threads;
    throw std::invalid_argument("boxstream: a TbbExecutor has 1 to 4096 threads");
  }

  tbb::task_arena arena_;
};

}  // namespace boxstream
