// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>

namespace boxstream::detail {

/// An atomic that can be moved while no other thread uses it.
template <class T>
struct MovableAtomic : std::atomic<T> {
  using std::atomic<T>::atomic;
  MovableAtomic(MovableAtomic&& other) noexcept : std::atomic<T>(other.load(std::memory_order_relaxed)) {}
  MovableAtomic& operator=(MovableAtomic&& other) noexcept {
    this->store(other.load(std::memory_order_relaxed), std::memory_order_relaxed);
    return *this;
  }
};

}  // namespace boxstream::detail
