// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>

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
  /// returned. `task` does not throw, starts no parallel work, and waits, a short time, only for tasks that have begun.
  /// Other jobs may run on the calling thread or its fibres meanwhile: the library holds no lock.
  /// A task left out or run twice ends the call of the library with std::logic_error. One that runs after the return,
  /// or twice at the same time, is undefined behaviour.
  virtual void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) = 0;

  /// About how many nanoseconds it takes until a task of a call made now starts on another thread: some thousand if
  /// threads wait for work without sleeping, some ten thousand if they have to be woken. Work that would be done by
  /// then is left to the calling thread. It is asked before each search or update that might use threads, and whether
  /// or not any is then used; so an executor may wake its threads when it is asked often.
  virtual std::uint32_t start_nanoseconds() { return 50000; }
};

}  // namespace boxstream
