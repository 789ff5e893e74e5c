// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include <pybind11/pybind11.h>

namespace boxstream::python {

/// Called now and then by a thread that has released the interpreter's lock. Lets Python handle signals, such as
/// Ctrl-C, twenty times a second; throws what their handlers raise.
class Signals {
 public:
  void check() {
    const auto now = std::chrono::steady_clock::now();
    if (now < next_) return;
    const pybind11::gil_scoped_acquire lock;
    if (PyErr_CheckSignals() != 0) throw pybind11::error_already_set();
    next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
  }

 private:
  std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now() + std::chrono::milliseconds(50);
};

}  // namespace boxstream::python
