// SPDX-License-Identifier: MIT
#include "executor.hpp"

#include <algorithm>
#include <string>

#include <unistd.h>

#include "arguments.hpp"

namespace boxstream::python {

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

std::shared_ptr<ThreadPool> ThreadPool::make(unsigned threads) {
  return {new ThreadPool(threads), [](ThreadPool* pool) {
            if (!pool->is_forked()) delete pool;
          }};
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

namespace {

std::shared_ptr<ThreadPool> make_pool(py::handle threads) {
  constexpr std::size_t most = 4096;
  const std::size_t count = threads.is_none() ? std::clamp<std::size_t>(std::thread::hardware_concurrency(), 1, most)
                                              : count_of(threads, "threads", 1);
  if (count > most) throw py::value_error("threads: expected at most 4096, got " + text_of(threads));
  return ThreadPool::make(static_cast<unsigned>(count));
}

}  // namespace

void add_executor(py::module_& module) {
  py::class_<ThreadPool, std::shared_ptr<ThreadPool>>(module, "Executor", R"(Executor(threads=None)

Threads for searches. Results do not depend on their number.

threads: int from 1 to 4096, the calling thread included; None: as many as this process may use.

One Executor may serve any number of Detectors and Worlds. Of searches that run at the same time, one gets its
threads; the others run on the thread that called them. In a child made by os.fork, where there are no other threads,
searches run on the calling thread.)")
      .def(py::init(&make_pool), py::arg("threads") = py::none())
      .def_property_readonly("threads", &ThreadPool::concurrency,
                             "int: the number of threads, the calling one included.")
      .def("__repr__", [](const ThreadPool& pool) {
        return "boxstream.Executor(threads=" + std::to_string(pool.concurrency()) + ")";
      });
}

}  // namespace boxstream::python
