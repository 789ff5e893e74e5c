// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

namespace boxstream::python {

namespace py = pybind11;

/// Something has been raised, and is noted in the thread. It passes through searches in place of pybind11's exception,
/// whose end needs the interpreter's lock.
struct Raised {};

/// Until the process ends.
[[noreturn]] void stay();

/// `call()`, of functions of Python's C interface alone: anything that needs the interpreter's lock.
///
/// Once the interpreter is ending, Python before 3.14 ends the thread that asks for the lock, from inside such a
/// function, by unwinding its stack: past destructors that need the lock or must not be left so, and out of a search
/// that other threads are at work on. Here it stays instead, as it does from 3.14 on.
template <class Call>
auto in_python(Call call) {
  try {
    return call();
  } catch (...) {  // functions of C throw nothing else
    stay();
  }
}

/// The calling thread is without the interpreter's lock for as long as this lives.
class Unlocked {
 public:
  Unlocked() : thread_(PyEval_SaveThread()) {}
  ~Unlocked() { lock(); }
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

  /// It has the lock again meanwhile. For its own thread.
  class Locked {
   public:
    explicit Locked(const Unlocked& unlocked) { unlocked.lock(); }
    ~Locked() { PyEval_SaveThread(); }
    Locked(const Locked&) = delete;
    Locked& operator=(const Locked&) = delete;
  };

 private:
  // pybind11 would look the thread up, in what may be gone when the interpreter is ending.
  void lock() const {
    in_python([this] { PyEval_RestoreThread(thread_); });
  }

  PyThreadState* thread_;
};

/// `use(unlocked)` without the interpreter's lock. With it, throws what has been raised meanwhile.
template <class Use>
auto without_lock(Use use) {
  try {
    const Unlocked unlocked;
    return use(unlocked);
  } catch (const Raised&) {
    throw py::error_already_set();
  }
}

}  // namespace boxstream::python
