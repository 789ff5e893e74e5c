// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "signals.hpp"

namespace boxstream::python {

/// Where pairs of a stream go: a Python callable, and how many it gets at a time.
struct Blocks {
  Blocks(py::handle callback, py::handle block, Indices indices);

  py::handle callback;  // borrowed
  std::size_t size;
  Indices indices;
};

/// Passes pairs on to the callable; it stops the search by returning False. Throws Raised if it raises. For a thread
/// without the interpreter's lock.
class BlockSink {
 public:
  BlockSink(const Blocks& blocks, const Unlocked& unlocked)
      : blocks_(blocks), unlocked_(unlocked), signals_(unlocked) {}

  bool operator()(Span<const Pair> pairs) {
    signals_.check();
    while (!pairs.empty()) {
      const std::size_t count = std::min(pairs.size(), blocks_.size - held_.size());
      held_.insert(held_.end(), pairs.begin(), pairs.begin() + count);
      pairs = pairs.subspan(count, pairs.size() - count);
      if (held_.size() == blocks_.size && !pass_on()) return false;
    }
    return true;
  }

  /// Passes on what is left, after a search that was not stopped.
  void finish() {
    if (!held_.empty()) pass_on();
  }

  std::uint64_t passed() const { return passed_; }

 private:
  bool pass_on();

  const Blocks& blocks_;
  const Unlocked& unlocked_;
  std::vector<Pair> held_;
  std::uint64_t passed_ = 0;
  Signals signals_;
};

}  // namespace boxstream::python
