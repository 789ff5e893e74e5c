// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace boxstream::detail {

/// One at a time, without a lock that is held meanwhile: for work that may run any other on its thread.
class Turns {
 public:
  /// Exclusive while it lives.
  class Turn {
   public:
    /// Waits for its turn. If `is_patient` is false, no longer than `patience`, and not at all on the thread that
    /// has the turn: it may be waiting for this one.
    Turn(Turns& turns, bool is_patient, std::chrono::nanoseconds patience) : turns_(turns) {
      const auto is_free = [&] { return turns_.holder_ == std::thread::id(); };
      std::unique_lock<std::mutex> lock(turns_.mutex_);
      if (is_patient)
        turns_.ended_.wait(lock, is_free);
      else if (turns_.holder_ == std::this_thread::get_id() || !turns_.ended_.wait_for(lock, patience, is_free))
        return;
      turns_.holder_ = std::this_thread::get_id();
      has_it_ = true;
    }
    ~Turn() {
      if (!has_it_) return;
      const std::lock_guard<std::mutex> lock(turns_.mutex_);
      turns_.holder_ = std::thread::id();
      turns_.ended_.notify_one();
    }
    Turn(const Turn&) = delete;
    Turn& operator=(const Turn&) = delete;
    /// False if it has waited in vain.
    explicit operator bool() const { return has_it_; }

   private:
    Turns& turns_;
    bool has_it_ = false;
  };

 private:
  std::mutex mutex_;
  std::condition_variable ended_;
  std::thread::id holder_;
};

}  // namespace boxstream::detail
