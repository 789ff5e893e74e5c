// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace boxstream::papers {

/// Weak deletion for any static structure: the objects in it are known by handles, and a table says which handles are
/// still alive. A deleted object stays in the structure, is found by queries, and left out of the answer. The table
/// also takes the place of the paper's search tree T from objects to structures: to mark an object, one need not know
/// where it is.
class Marks {
 public:
  using Handle = std::uint32_t;

  /// `number` is what the caller calls the object.
  Handle add(std::uint32_t number) {
    ++live_;
    while (!free_.empty() && free_.back().empty()) free_.pop_back();
    if (free_.empty()) {
      entries_.push_back({number, true});
      return static_cast<Handle>(entries_.size() - 1);
    }
    const Handle handle = free_.back().back();
    free_.back().pop_back();
    entries_[handle] = {number, true};
    return handle;
  }

  /// False if it is not alive.
  bool kill(Handle handle) {
    if (!alive(handle)) return false;
    entries_[handle].alive = false;
    killed_.push_back(handle);
    --live_;
    return true;
  }

  bool alive(Handle handle) const { return handle < entries_.size() && entries_[handle].alive; }
  std::uint32_t number(Handle handle) const { return entries_[handle].number; }
  std::size_t live() const { return live_; }

  /// Handles killed so far, to be given back with `reuse` once no structure holds them any more. Both take the same
  /// time whatever their number.
  std::vector<Handle> take_killed() { return std::exchange(killed_, {}); }
  void reuse(std::vector<Handle> handles) { free_.push_back(std::move(handles)); }

 private:
  struct Entry {
    std::uint32_t number;
    bool alive;
  };
  std::vector<Entry> entries_;
  std::vector<Handle> killed_;
  std::vector<std::vector<Handle>> free_;
  std::size_t live_ = 0;
};

}  // namespace boxstream::papers
