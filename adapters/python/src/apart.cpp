// SPDX-License-Identifier: MIT
#include "apart.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <iterator>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <vector>

#include <unistd.h>

#include "signals.hpp"

namespace boxstream::python {

namespace {

class Job {
 public:
  explicit Job(std::function<void()> work) : work_(std::move(work)), thread_([this] { run(); }) {}
  ~Job() {
    if (getpid() == process_)
      thread_.join();
    else  // a child has no such thread: it can be neither joined nor let go
      static_cast<void>(new std::thread(std::move(thread_)));
  }
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Without a lock, which a fork might have left held.
  bool has_ended() const { return ended_; }

  void wait(const Unlocked& unlocked) {
    Signals signals(unlocked);
    for (std::unique_lock lock(mutex_);
         !end_.wait_for(lock, std::chrono::milliseconds(10), [this] { return ended_.load(); });) {
      lock.unlock();
      signals.check();
      // A handler that forked: the child has no such thread, and cannot wait for it.
      if (getpid() != process_)
        throw std::runtime_error("the search stayed in the process that this one was forked from");
      lock.lock();
    }
  }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void run() noexcept {
    try {
      work_();
    } catch (...) {
      thrown_ = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    end_.notify_all();
  }

  const pid_t process_ = getpid();
  std::function<void()> work_;
  std::exception_ptr thrown_;
  std::mutex mutex_;
  std::condition_variable end_;
  std::atomic<bool> ended_ = false;
  std::thread thread_;  // the last member: it uses the others
};

/// Never destroyed: the process may end before they do. Guarded by the interpreter's lock.
std::vector<std::unique_ptr<Job>>& left_alone() {
  static auto* const jobs = new std::vector<std::unique_ptr<Job>>;
  return *jobs;
}

}  // namespace

void let_go() {
  std::vector<std::unique_ptr<Job>>& jobs = left_alone();
  const auto ended = std::stable_partition(jobs.begin(), jobs.end(), [](auto& job) { return !job->has_ended(); });
  // What is let go may call Python, and that this function.
  const std::vector<std::unique_ptr<Job>> gone(std::make_move_iterator(ended), std::make_move_iterator(jobs.end()));
  jobs.erase(ended, jobs.end());
}

void run_apart(std::function<void()> work, std::atomic<bool>* left) {
  let_go();
  left_alone().reserve(left_alone().size() + 1);
  std::unique_ptr<Job> job;
  try {
    job = std::make_unique<Job>(work);
  } catch (const std::system_error&) {  // no more threads
    without_lock([&](const Unlocked&) { work(); });
    return;
  }
  try {
    without_lock([&](const Unlocked& unlocked) { job->wait(unlocked); });
  } catch (...) {
    if (left != nullptr) *left = true;
    left_alone().push_back(std::move(job));
    throw;
  }
  job->rethrow();
}

}  // namespace boxstream::python
