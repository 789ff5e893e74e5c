// SPDX-License-Identifier: MIT
#include "peers/thread_executor.hpp"

namespace boxstream::bench {

ThreadExecutor::ThreadExecutor(unsigned threads) {
  for (unsigned i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
}

ThreadExecutor::~ThreadExecutor() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void ThreadExecutor::Job::work() {
  for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) task(i);
}

void ThreadExecutor::parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) {
  if (count < 2 || helpers_.empty()) {
    for (std::size_t i = 0; i < count; ++i) task(i);
    return;
  }
  Job job{task, count};
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
}

void ThreadExecutor::help() {
  std::unique_lock lock(mutex_);
  for (;;) {
    wake_.wait(lock,
               [this] { return stopping_ || (job_ && job_->next.load(std::memory_order_relaxed) < job_->count); });
    if (stopping_) return;
    Job& job = *job_;
    ++working_;
    lock.unlock();
    job.work();
    lock.lock();
    if (--working_ == 0) idle_.notify_all();
  }
}

}  // namespace boxstream::bench
