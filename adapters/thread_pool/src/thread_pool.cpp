// SPDX-License-Identifier: MIT
#include "thread_pool.hpp"

#include <unistd.h>

namespace boxstream::threads {

ThreadPool::ThreadPool(unsigned threads) : process_(getpid()) {
  try {
    for (unsigned i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
  } catch (...) {
    stop();
    throw;
  }
}

ThreadPool::~ThreadPool() {
  stop();
}

bool ThreadPool::is_forked() const {
  return getpid() != process_;
}

void ThreadPool::stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void ThreadPool::Job::work() {
  for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) task(i);
}

void ThreadPool::parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) {
  Job job{task, count};
  if (count < 2 || helpers_.empty() || is_forked() || taken_.test_and_set(std::memory_order_acquire)) return job.work();
  {
    const std::lock_guard lock(mutex_);
    job_ = &job;
  }
  wake_.notify_all();
  job.work();
  // Helpers that have not woken up by now find no job; those inside it finish the tasks they took.
  std::unique_lock lock(mutex_);
  job_ = nullptr;
  idle_.wait(lock, [this] { return working_ == 0; });
  taken_.clear(std::memory_order_release);
}

void ThreadPool::help() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock, [this] { return stopping_ || (job_ != nullptr && job_->has_tasks()); });
    if (stopping_) return;
    Job& job = *job_;
    ++working_;
    lock.unlock();
    job.work();
    lock.lock();
    if (--working_ == 0) idle_.notify_all();
  }
}

}  // namespace boxstream::threads
