// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace boxstream::detail {

/// A critical section without a mutex held inside: the work in it may run other jobs on its thread.
class ExclusiveSection {
 public:
  /// Owns the section while it lives, if it converts to true.
  class Entry {
   public:
    /// Waits until the section is free: for ever if `has_timeout` is false, else up to `timeout`, and not at all on the
    /// thread that owns it, which would be a deadlock.
    Entry(ExclusiveSection& section, bool has_timeout, std::chrono::nanoseconds timeout) : section_(section) {
      const auto is_free = [&] { return section_.owner_ == std::thread::id(); };
      std::unique_lock<std::mutex> lock(section_.mutex_);
      if (!has_timeout)
        section_.freed_.wait(lock, is_free);
      else if (section_.owner_ == std::this_thread::get_id() || !section_.freed_.wait_for(lock, timeout, is_free))
        return;
      section_.owner_ = std::this_thread::get_id();
      owns_ = true;
    }
    ~Entry() {
      if (!owns_) return;
      const std::lock_guard<std::mutex> lock(section_.mutex_);
      section_.owner_ = std::thread::id();
      section_.freed_.notify_one();
    }
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;
    /// False after a timeout.
    explicit operator bool() const { return owns_; }

   private:
    ExclusiveSection& section_;
    bool owns_ = false;
  };

 private:
  std::mutex mutex_;
  std::condition_variable freed_;
  std::thread::id owner_;
};

}  // namespace boxstream::detail
