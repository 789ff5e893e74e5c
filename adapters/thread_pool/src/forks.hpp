// SPDX-License-Identifier: MIT
#pragma once

namespace boxstream::threads {

/// What wants to know when the process forks. Its calls are on the thread that forks, and must not throw.
class SeesForks {
 public:
  virtual void before_fork() = 0;
  virtual void after_fork_in_parent() = 0;
  /// No other thread is there.
  virtual void after_fork_in_child() = 0;

 protected:
  ~SeesForks() = default;
};

/// Lets one of them see all forks for as long as this lives. Forks by bare system calls are not seen.
class ForkWatch {
 public:
  explicit ForkWatch(SeesForks& watcher);
  ~ForkWatch();
  ForkWatch(const ForkWatch&) = delete;
  ForkWatch& operator=(const ForkWatch&) = delete;

 private:
  friend struct AllWatches;

  SeesForks& watcher_;
  ForkWatch *previous_ = nullptr, *next_;  // of all that live
};

}  // namespace boxstream::threads
