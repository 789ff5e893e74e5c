// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "unlocked.hpp"

namespace boxstream::python {

/// Called now and then by a thread that is without the interpreter's lock. Lets Python handle signals, such as Ctrl-C,
/// twenty times a second; throws Raised if their handlers raise.
class Signals {
 public:
  explicit Signals(const Unlocked& unlocked) : unlocked_(unlocked) {}

  void check() {
    if (Clock::now() < next_) return;
    const Unlocked::Locked locked(unlocked_);
    if (in_python(PyErr_CheckSignals) != 0) throw Raised();
    next_ = soon();
  }

 private:
  using Clock = std::chrono::steady_clock;
  static Clock::time_point soon() { return Clock::now() + std::chrono::milliseconds(50); }

  const Unlocked& unlocked_;
  Clock::time_point next_ = soon();
};

}  // namespace boxstream::python
