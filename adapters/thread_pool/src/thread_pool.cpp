// SPDX-License-Identifier: MIT
#include "thread_pool.hpp"

#include <algorithm>
#include <chrono>

#include "spin.hpp"

namespace boxstream::threads {

namespace {

// A thread that looks out for this long and finds nothing has wasted a few times what waking it takes. The phases of an
// update and the steps of a search lie closer together.
constexpr std::chrono::microseconds look_out{200};

// A caller that asks again that soon is likely to have a job for threads that are woken.
constexpr std::chrono::milliseconds in_succession{2};
constexpr std::uint32_t most_calls_in_vain = 8;

// Until a task starts on another thread: measured on a virtual machine with two cores.
constexpr std::uint32_t start_of_awake = 3000, start_of_sleeping = 50000;

// There, threads that are awake start a search within 0.3 to 0.45 microseconds on cores that share a cache, and within
// 0.6 to 0.8 on cores that do not. Then searches in close succession lose time up to some 100 000 boxes.
constexpr std::int64_t start_of_near = 520;
constexpr std::uint32_t start_of_distant = 300000;

}  // namespace

ThreadPool::ThreadPool(unsigned threads) : is_crowded_(threads > std::thread::hardware_concurrency()) {
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

void ThreadPool::stop() {
  stopping_ = true;
  wake();
  for (std::thread& helper : helpers_) helper.join();
}

/// In nanoseconds.
std::int64_t ThreadPool::now() {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::uint32_t ThreadPool::start_nanoseconds() {
  const std::int64_t asked_at = now(), before = asked_at_.exchange(asked_at, std::memory_order_relaxed);
  if (is_distant()) return start_of_distant;
  if (sleeping_ == 0) return start_of_awake;
  if (std::chrono::nanoseconds(asked_at - before) < in_succession && !is_forked_) call();
  return start_of_sleeping;
}

void ThreadPool::note_start(std::int64_t nanoseconds) {
  if (nanoseconds < start_of_near)
    slow_starts_ = 0;
  else
    ++slow_starts_;
}

/// Any other process may delay a start, so one says nothing; and now and then it is tried again.
bool ThreadPool::is_distant() {
  constexpr std::uint32_t enough = 8, until_next_try = 128;
  return slow_starts_ >= enough && ++asked_while_distant_ % until_next_try != 0;
}

/// Wakes helpers for a job that is likely to come. After calls in vain, only every second, fourth ... time.
void ThreadPool::call() {
  const std::uint32_t in_vain = calls_in_vain_;
  if (++asked_in_vain_ < 1u << in_vain) return;
  asked_in_vain_ = 0;
  calls_in_vain_ = std::min(in_vain + 1, most_calls_in_vain);
  ++calls_;
  wake();
}

/// After what they are to see has changed.
void ThreadPool::wake() {
  { const std::lock_guard lock(mutex_); }  // a helper that has not seen it is asleep now
  wake_.notify_all();
}

void ThreadPool::Job::work() {
  for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) task(i);
}

void ThreadPool::Door::open(Job& job) {
  job_ = &job;
  const auto number = static_cast<Number>(state_.load() >> number_shift) + 1;
  state_.store(std::uint64_t{number} << number_shift | opened);
}

ThreadPool::Job* ThreadPool::Door::enter(Number& last) {
  std::uint64_t state = state_.load();
  while (is_open(state, last))
    if (state_.compare_exchange_weak(state, state + inside)) {
      last = static_cast<Number>(state >> number_shift);
      return job_;
    }
  return nullptr;
}

void ThreadPool::parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) {
  Job job{task, count, now()};
  if (count < 2 || concurrency() == 1 || taken_.test_and_set(std::memory_order_acquire)) return job.work();
  caller_.store(std::this_thread::get_id(), std::memory_order_relaxed);
  run_with_helpers(job);
  caller_.store({}, std::memory_order_relaxed);
  taken_.clear(std::memory_order_release);
}

void ThreadPool::run_with_helpers(Job& job) {
  door_.open(job);
  calls_in_vain_ = 0;
  if (sleeping_ != 0) wake();
  job.work();
  door_.close();
  // Helpers that have not come by now find no job; those inside it finish the tasks they took.
  wait_for_helpers();
}

/// The child goes on with the job of the thread that forks: helpers leave it, so that no task is half done and nothing
/// locked. Another thread's job ends with that thread.
void ThreadPool::before_fork() {
  if (!is_at_work_here()) return;
  door_.close();
  wait_for_helpers();
}

void ThreadPool::after_fork_in_parent() {
  if (!is_at_work_here() || is_forked_) return;
  door_.open_again();
  if (sleeping_ != 0) wake();
}

void ThreadPool::wait_for_helpers() {
  if (spin(look_out, is_crowded_, [this] { return door_.is_empty(); })) return;
  std::unique_lock lock(mutex_);
  caller_is_waiting_ = true;
  idle_.wait(lock, [this] { return door_.is_empty(); });
  caller_is_waiting_ = false;
}

/// Returns whether it did not sleep.
bool ThreadPool::wait_for_job(Door::Number last, std::chrono::nanoseconds most) {
  const auto is_over = [&] { return stopping_ || door_.is_open(last); };
  if (spin(most, is_crowded_, is_over)) return true;
  std::unique_lock lock(mutex_);
  ++sleeping_;
  const std::uint32_t calls = calls_;
  wake_.wait(lock, [&] { return is_over() || calls_ != calls; });
  --sleeping_;
  return false;
}

void ThreadPool::help() {
  Door::Number last = 0;
  std::chrono::nanoseconds patience = look_out;
  while (!stopping_) {
    const bool was_awake = wait_for_job(last, patience);
    patience = was_awake ? look_out : in_succession;  // it may have been called before there is a job
    Job* const job = door_.enter(last);
    if (job == nullptr) continue;
    if (was_awake) note_start(now() - job->opened_at);
    job->work();
    if (door_.leave() && caller_is_waiting_) {
      { const std::lock_guard lock(mutex_); }
      idle_.notify_all();
    }
  }
}

}  // namespace boxstream::threads
