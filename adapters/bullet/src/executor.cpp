// SPDX-License-Identifier: MIT
#include <boxstream/bullet/executor.hpp>
#include <boxstream/bullet/precision.hpp>

#include <algorithm>
#include <atomic>
#include <thread>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

/// A loop over workers, each of which takes tasks until there are none.
class Workers final : public btIParallelForBody {
 public:
  Workers(int workers, std::size_t tasks, FunctionRef<void(std::size_t)> task)
      : task_(task), tasks_(tasks), working_(workers) {}

  /// Tasks start in ascending order, however the scheduler batches them: results are delivered in that order, and less
  /// has to be held back.
  void forLoop(int begin, int end) const override {
    for (std::size_t i; (i = next_.fetch_add(1, std::memory_order_relaxed)) < tasks_;) task_(i);
    working_.fetch_sub(end - begin, std::memory_order_release);  // *this may be gone now
  }

  /// A scheduler that has returned is nearly always done.
  void wait() const {
    while (working_.load(std::memory_order_acquire) > 0) std::this_thread::yield();
  }

 private:
  FunctionRef<void(std::size_t)> task_;
  std::size_t tasks_;
  mutable std::atomic<std::size_t> next_{0};
  mutable std::atomic<int> working_;
};

}  // namespace

unsigned TaskSchedulerExecutor::concurrency() const {
  const btITaskScheduler* const threads = scheduler();
  // Some have 0 until setNumThreads is called.
  return threads ? unsigned(std::max(1, threads->getNumThreads())) : 1;
}

void TaskSchedulerExecutor::parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) {
  const int workers = int(std::min<std::size_t>(count, concurrency()));
  const Workers body(workers, count, task);
  if (workers > 1) {
    scheduler()->parallelFor(0, workers, 1, body);
    body.wait();
  } else {
    body.forLoop(0, workers);
  }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
