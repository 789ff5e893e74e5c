// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>

#include <boxstream/function_ref.hpp>

namespace boxstream {

/// Where parallel work runs. The library owns no threads: derive from this to lend it your scheduler.
/// Results never depend on the executor, only the time they take does.
class Executor {
 public:
  virtual ~Executor() = default;

  /// How many tasks may usefully run at once, >= 1.
  virtual unsigned concurrency() const = 0;

  /// Calls `task(i)` once for each i in [0, count), in any order and on any threads, and returns when all have
  /// returned. `task` does not throw and starts no parallel work of its own. It may wait a short time for tasks that
  /// other threads are at work on, never for tasks that have not started.
  ///
  /// Before it returns it may do other work of its own on the calling thread, or on other fibres of it: the library
  /// holds no lock meanwhile.
  virtual void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) = 0;
};

}  // namespace boxstream
