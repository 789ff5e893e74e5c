// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>

#include <LinearMath/btThreads.h>

#include <boxstream/bullet.hpp>
#include <boxstream/detail/export.hpp>
#include <boxstream/executor.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Runs parallel work on the threads that Bullet has already, those of a btITaskScheduler:
///
///     btSetTaskScheduler(btCreateDefaultTaskScheduler());  // as for Bullet's own *Mt classes
///     boxstream::bullet::TaskSchedulerExecutor executor;
///     boxstream::bullet::Options options;
///     options.executor = &executor;
///
/// Bullet has such threads only if it was built with BT_THREADSAFE. Debian's was not: there,
/// btCreateDefaultTaskScheduler and the like return null, and everything runs on the calling thread. A scheduler of
/// your own works with every build.
///
/// One may serve any number of broad-phases, Detectors and Worlds, and must outlive them. It has no state but the
/// pointer. Two calls at the same time, or one from within a loop of the scheduler, are as good as the scheduler
/// makes them: Bullet's default one then runs the later call on its calling thread alone. Results do not depend on it.
/// As no scheduler tells whether its threads sleep, they are taken to.
class BOXSTREAM_API TaskSchedulerExecutor final : public Executor {
 public:
  /// `scheduler` is borrowed for the life of the executor; it need not be the one that is set. Null: at each call, the
  /// one that btGetTaskScheduler names then, if any. That one is global to the process: set another, delete it or call
  /// its setNumThreads only while no search runs. A scheduler that throws has to have ended its loop first.
  explicit TaskSchedulerExecutor(btITaskScheduler* scheduler = nullptr) : given_(scheduler) {}

  /// What getNumThreads says now, 1 without a scheduler.
  unsigned concurrency() const override;

  /// Returns when all tasks have, even if the scheduler gives up earlier: Bullet's default one waits for 0.1 s at most.
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override;

 private:
  btITaskScheduler* scheduler() const { return given_ ? given_ : btGetTaskScheduler(); }

  btITaskScheduler* given_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
