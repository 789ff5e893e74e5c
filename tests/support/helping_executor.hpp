// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <utility>

#include <boxstream/executor.hpp>

namespace boxstream::tests {

/// A scheduler of jobs that waits by working: after the first task of a parallel_for the calling thread does all jobs
/// that are still due before it goes on. These may be at a parallel_for themselves, and do the rest of the jobs there.
/// For one thread.
class HelpingExecutor final : public Executor {
 public:
  void add(std::function<void()> job) { due_.push_back(std::move(job)); }

  unsigned concurrency() const override { return 4; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i < count; ++i) {
      task(i);
      ++depth_;
      while (!due_.empty()) {
        const auto job = std::move(due_.front());
        due_.pop_front();
        deepest_ = depth_ > deepest_ ? depth_ : deepest_;
        job();
      }
      --depth_;
    }
  }

  /// The greatest number of nested calls of parallel_for in which a job began.
  std::size_t deepest() const { return deepest_; }

 private:
  std::deque<std::function<void()>> due_;
  std::size_t depth_ = 0;
  std::size_t deepest_ = 0;
};

}  // namespace boxstream::tests
