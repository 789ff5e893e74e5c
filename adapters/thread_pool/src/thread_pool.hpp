// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

#include <sys/types.h>

#include <boxstream/executor.hpp>

namespace boxstream::threads {

/// Threads that take the next task from a shared counter; the calling thread is one of them. Of searches that run at
/// the same time one gets the threads; the others run on their own. After a fork, whose child has no other threads, the
/// calling thread does everything.
class ThreadPool final : public Executor {
 public:
  /// Starts `threads` - 1; at least one is meant.
  explicit ThreadPool(unsigned threads);
  /// Waits for the threads. Not to be called in the child of a fork.
  ~ThreadPool() override;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  unsigned concurrency() const override { return static_cast<unsigned>(helpers_.size()) + 1; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override;

  /// Whether this is the child of a fork, made after the pool.
  bool is_forked() const;

 private:
  struct Job {
    FunctionRef<void(std::size_t)> task;
    std::size_t count;
    std::atomic<std::size_t> next{0};

    void work();
    bool has_tasks() const { return next.load(std::memory_order_relaxed) < count; }
  };

  void help();
  void stop();

  std::vector<std::thread> helpers_;
  pid_t process_;
  std::atomic_flag taken_;  // by the search that has the threads
  std::mutex mutex_;        // of the members below
  std::condition_variable wake_, idle_;
  Job* job_ = nullptr;
  std::size_t working_ = 0;
  bool stopping_ = false;
};

}  // namespace boxstream::threads
