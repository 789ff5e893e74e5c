// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "signals.hpp"

namespace boxstream::python {

/// Passes pairs on to a Python callable, `block` at a time; it stops the search by returning False. Called without the
/// interpreter's lock.
class BlockSink {
 public:
  /// The callable is borrowed: the lock is not held where a sink ends.
  BlockSink(const py::object& callback, py::handle block) : callback_(callback), block_(count_of(block, "block", 1)) {
    if (PyCallable_Check(callback.ptr()) == 0)
      throw py::type_error("callback: expected a callable, got an object of type " + type_of(callback));
  }

  bool operator()(Span<const Pair> pairs) {
    signals_.check();
    while (!pairs.empty()) {
      const std::size_t count = std::min(pairs.size(), block_ - held_.size());
      held_.insert(held_.end(), pairs.begin(), pairs.begin() + count);
      pairs = pairs.subspan(count, pairs.size() - count);
      if (held_.size() == block_ && !pass_on()) return false;
    }
    return true;
  }

  /// Passes on what is left, after a search that was not stopped.
  void finish() {
    if (!held_.empty()) pass_on();
  }

  std::uint64_t passed() const { return passed_; }

 private:
  bool pass_on() {
    passed_ += held_.size();
    const py::gil_scoped_acquire lock;
    const py::object answer = callback_(array_of<std::uint32_t>(std::exchange(held_, {})));
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return answer.ptr() != Py_False;
  }

  const py::object& callback_;
  std::size_t block_;
  std::vector<Pair> held_;
  std::uint64_t passed_ = 0;
  Signals signals_;
};

}  // namespace boxstream::python
