// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <thread>
#include <vector>

#include <boxstream/executor.hpp>

namespace boxstream::bench {

/// Threads that take the next task from a shared counter. The caller works too, so `threads` - 1 are started.
class ThreadExecutor final : public Executor {
 public:
  explicit ThreadExecutor(unsigned threads);
  ~ThreadExecutor() override;
  ThreadExecutor(const ThreadExecutor&) = delete;
  ThreadExecutor& operator=(const ThreadExecutor&) = delete;

  unsigned concurrency() const override { return static_cast<unsigned>(helpers_.size()) + 1; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override;

 private:
  struct Job {
    FunctionRef<void(std::size_t)> task;
    std::size_t count;
    std::atomic<std::size_t> next{0};
    void work();
  };

  void help();

  std::vector<std::thread> helpers_;
  std::mutex mutex_;
  std::condition_variable wake_, idle_;
  Job* job_ = nullptr;
  std::size_t working_ = 0;  // helpers inside the job
  bool stopping_ = false;
};

}  // namespace boxstream::bench
