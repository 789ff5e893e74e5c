// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include <boxstream/stats.hpp>

#include "base/arena.hpp"
#include "batch/parallel/waiting_pairs.hpp"

namespace boxstream::detail {

/// State of parallel work kept between calls: an arena for each worker, and pairs of tasks that wait for delivery. The
/// assignment of tasks to workers is random, so all arenas grow to the size needed by the largest task: then none grows
/// later. A thread gets the arena that it had before, if it can: what it wrote there is in its processor's caches.
class TaskPool {
 public:
  struct alignas(64) Task {  // 64: no false sharing
    WaitingPairs held;
    Stats stats;
    bool started = false;
    bool done = false;  // with all its pairs in `held` or passed on
  };

  /// Makes `tasks` fresh tasks, for `workers` workers that may hold back `most_held` pairs together.
  void prepare(std::size_t tasks, std::size_t workers, std::size_t most_held) {
    room_.clear(most_held);
    tasks_.clear();
    tasks_.resize(tasks);
    arenas_.reserve(workers);
    idle_.reserve(workers);
    while (arenas_.size() < workers) {
      arenas_.push_back(std::make_unique<Arena>());
      idle_.push_back({arenas_.back().get(), {}});
    }
  }

  std::size_t tasks() const { return tasks_.size(); }
  Task& task(std::size_t i) {
    assert(i < tasks_.size());
    return tasks_[i];
  }
  WaitingPairsRoom& room() { return room_; }

  /// An arena of its own for as long as the Lease lives.
  class Lease {
   public:
    explicit Lease(TaskPool& pool) : pool_(pool), arena_(pool.acquire()) {}
    ~Lease() { pool_.release(arena_); }
    Lease(const Lease&) = delete;
    Lease& operator=(const Lease&) = delete;
    Arena& arena() { return arena_; }

   private:
    TaskPool& pool_;
    Arena& arena_;
  };

  void settle() noexcept {
    std::size_t peak = 0;
    for (const auto& arena : arenas_) peak = peak < arena->peak() ? arena->peak() : peak;
    for (const auto& arena : arenas_) arena->settle(peak);
  }

  /// Gives all memory back.
  void shrink_to_fit() noexcept {
    std::vector<Task>().swap(tasks_);
    std::vector<Idle>().swap(idle_);
    std::vector<std::unique_ptr<Arena>>().swap(arenas_);
    room_.shrink_to_fit();
  }

  std::size_t capacity() const {
    std::size_t bytes = room_.capacity();
    for (const auto& arena : arenas_) bytes += arena->capacity();
    return bytes;
  }

 private:
  Arena& acquire() {
    const std::lock_guard lock(mutex_);
    if (idle_.empty()) {  // more threads than workers were prepared for
      idle_.reserve(arenas_.size() + 1);
      arenas_.push_back(std::make_unique<Arena>());
      return *arenas_.back();
    }
    std::size_t at = idle_.size() - 1;
    for (std::size_t i = 0; i < idle_.size(); ++i)
      if (idle_[i].last_user == std::this_thread::get_id()) at = i;
    Arena* const arena = idle_[at].arena;
    idle_[at] = idle_.back();
    idle_.pop_back();
    return *arena;
  }

  void release(Arena& arena) {
    const std::lock_guard lock(mutex_);
    idle_.push_back({&arena, std::this_thread::get_id()});
  }

  struct Idle {
    Arena* arena;
    std::thread::id last_user;
  };

  std::mutex mutex_;
  std::vector<std::unique_ptr<Arena>> arenas_;
  std::vector<Idle> idle_;
  std::vector<Task> tasks_;
  WaitingPairsRoom room_;
};

}  // namespace boxstream::detail
