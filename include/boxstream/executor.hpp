// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>

#include <boxstream/detail/export.hpp>
#include <boxstream/function_ref.hpp>

namespace boxstream {

/// Runs parallel work. The library owns no threads: derive from this to use your scheduler. Results do not depend on
/// it.
class BOXSTREAM_API Executor {
 public:
  virtual ~Executor() = default;

  /// How many tasks may usefully run at once, >= 1.
  virtual unsigned concurrency() const = 0;

  /// Calls `task(i)` once for each i in [0, count), in any order and on any threads, and returns when all have
  /// returned. `task` does not throw and starts no parallel work. It may wait a short time for tasks that run on other
  /// threads, never for tasks that have not started.
  ///
  /// It may run other jobs on the calling thread or its fibres before it returns: the library holds no lock meanwhile.
  virtual void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) = 0;
};

}  // namespace boxstream
