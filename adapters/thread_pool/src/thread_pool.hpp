// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include <boxstream/executor.hpp>

#include "forks.hpp"

namespace boxstream::threads {

/// Threads that take the next task from a shared counter; the calling thread is one of them. Of searches that run at
/// the same time one gets the threads; the others run on their own.
///
/// The child of a fork has no other threads: there the calling thread does everything. A task may fork too, if it is
/// one that the calling thread runs. The others finish the tasks they are in before, and the child does what is left.
///
/// After its tasks a thread looks out for more for 0.2 ms before it sleeps, so that calls in close succession do not
/// wake it each time, which takes 30 to 50 microseconds.
///
/// How long an awake thread takes to start says how far its processor is from that of the caller. Where they share no
/// cache, boxes that would have stayed in one have to be moved to the other, which takes longer than a small search.
class ThreadPool final : public Executor, private SeesForks {
 public:
  /// Starts `threads` - 1; at least one is meant.
  explicit ThreadPool(unsigned threads);
  /// Waits for the threads. Not to be called in the child of a fork.
  ~ThreadPool() override;
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// 1 in the child of a fork.
  unsigned concurrency() const override { return is_forked_ ? 1 : static_cast<unsigned>(helpers_.size()) + 1; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override;
  /// Little while no thread sleeps and they are near; for those that are not, what makes up for moving the boxes. To
  /// ask again before near ones would fall asleep wakes them, for the next time.
  std::uint32_t start_nanoseconds() override;

  /// Whether this is the child of a fork, made after the pool.
  bool is_forked() const { return is_forked_; }

 private:
  struct Job {
    FunctionRef<void(std::size_t)> task;
    std::size_t count;
    std::int64_t opened_at;  // by now()
    std::atomic<std::size_t> next{0};

    void work();
  };

  /// The job that is open, if any, and how many helpers are inside it: they enter and leave without a lock, in which
  /// one would send another to sleep.
  class Door {
   public:
    using Number = std::uint32_t;  ///< of a job, counted up and beginning anew

    /// No helper may be inside.
    void open(Job& job);
    /// The same job once more, as another one to helpers.
    void open_again() { open(*job_); }
    /// Whether a job is open that is not the last one a helper was in.
    bool is_open(Number last) const { return is_open(state_.load(), last); }
    /// The job, and its number; null if it is closed by now.
    Job* enter(Number& last);
    /// Whether the last helper has left.
    bool leave() { return is_empty(state_.fetch_sub(inside) - inside); }
    /// From now on no helper enters.
    void close() { state_.fetch_and(~opened); }
    bool is_empty() const { return is_empty(state_.load()); }

   private:
    static constexpr std::uint64_t inside = 1;  // one helper; of up to 2^31 - 1
    static constexpr std::uint64_t opened = std::uint64_t{1} << 31;
    static constexpr int number_shift = 32;

    static bool is_empty(std::uint64_t state) { return (state & (opened - 1)) == 0; }
    static bool is_open(std::uint64_t state, Number last) {
      return (state & opened) != 0 && static_cast<Number>(state >> number_shift) != last;
    }

    std::atomic<std::uint64_t> state_{0};
    Job* job_ = nullptr;  // changed while no helper is inside
  };

  static std::int64_t now();
  void help();
  void stop();
  void call();
  void wake();
  bool wait_for_job(Door::Number last, std::chrono::nanoseconds most);
  void note_start(std::int64_t nanoseconds);
  bool is_distant();
  void wait_for_helpers();
  void run_with_helpers(Job& job);
  bool is_at_work_here() const { return caller_.load(std::memory_order_relaxed) == std::this_thread::get_id(); }
  void before_fork() override;
  void after_fork_in_parent() override;
  void after_fork_in_child() override { is_forked_ = true; }

  std::vector<std::thread> helpers_;
  bool is_forked_ = false;                 // changed while there is one thread
  bool is_crowded_;                        // more threads than processors
  std::atomic_flag taken_;                 // by the search that has the threads
  std::atomic<std::thread::id> caller_{};  // of that search
  Door door_;
  std::atomic<bool> stopping_{false};

  // A thread that waits changes one of these and then looks at the door; a thread that changes the door looks at these
  // afterwards. All of it is sequentially consistent, so that no wake-up is lost.
  std::atomic<std::size_t> sleeping_{0};  // helpers
  std::atomic<std::uint32_t> calls_{0};
  std::atomic<bool> caller_is_waiting_{false};
  std::mutex mutex_;
  std::condition_variable wake_, idle_;

  std::atomic<std::int64_t> asked_at_{0};
  std::atomic<std::uint32_t> asked_in_vain_{0}, calls_in_vain_{0};
  // Starts of threads that were awake, too late for near ones and one after the other; questions since.
  std::atomic<std::uint32_t> slow_starts_{0}, asked_while_distant_{0};

  ForkWatch watch_{*this};  // last: all else is there when a fork is seen
};

}  // namespace boxstream::threads
