// SPDX-License-Identifier: MIT
#include "forks.hpp"

#include <mutex>
#include <stdexcept>

#include <pthread.h>

namespace boxstream::threads {

/// Constant from the start, and never destroyed: a process may fork in its first moment and in its last.
struct AllWatches {
  /// Locked from before a fork until after it: the child gets a list that no other thread was changing.
  inline static constinit std::mutex mutex;
  inline static constinit ForkWatch* first = nullptr;
  /// As the library is loaded. With the first pool would be too late: a child of a fork in the middle of that would
  /// wait for a thread that it does not have.
  static const bool has_failed;

  template <class Call>
  static void call(const Call& each) {
    for (ForkWatch* watch = first; watch != nullptr; watch = watch->next_) each(watch->watcher_);
  }
  static void before() {
    mutex.lock();
    call([](SeesForks& watcher) { watcher.before_fork(); });
  }
  static void in_parent() {
    call([](SeesForks& watcher) { watcher.after_fork_in_parent(); });
    mutex.unlock();
  }
  static void in_child() {
    call([](SeesForks& watcher) { watcher.after_fork_in_child(); });
    mutex.unlock();
  }
};

const bool AllWatches::has_failed = pthread_atfork(&before, &in_parent, &in_child) != 0;

ForkWatch::ForkWatch(SeesForks& watcher) : watcher_(watcher) {
  if (AllWatches::has_failed) throw std::runtime_error("boxstream: the system keeps no more functions for forks");
  const std::lock_guard lock(AllWatches::mutex);
  next_ = AllWatches::first;
  if (next_ != nullptr) next_->previous_ = this;
  AllWatches::first = this;
}

ForkWatch::~ForkWatch() {
  const std::lock_guard lock(AllWatches::mutex);
  (previous_ == nullptr ? AllWatches::first : previous_->next_) = next_;
  if (next_ != nullptr) next_->previous_ = previous_;
}

}  // namespace boxstream::threads
