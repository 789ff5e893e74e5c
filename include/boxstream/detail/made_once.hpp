// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>

namespace boxstream::detail {

/// Owns a T that the first call of `get` makes, on any thread. `T` may be incomplete where none of these is called.
template <class T>
class MadeOnce {
 public:
  MadeOnce() = default;
  ~MadeOnce() { reset(); }
  MadeOnce(MadeOnce&& other) noexcept : made_(other.take()) {}
  MadeOnce& operator=(MadeOnce&& other) noexcept {
    T* const taken = other.take();
    reset();
    made_.store(taken, std::memory_order_relaxed);
    return *this;
  }

  /// Null before.
  T* made() const { return made_.load(std::memory_order_acquire); }
  template <class Options>
  T& get(const Options& options) {
    T* const there = made();
    return there != nullptr ? *there : make(options);
  }
  void reset() noexcept { delete take(); }

 private:
  template <class Options>
  T& make(const Options& options) {
    auto made = std::make_unique<T>(options);
    T* first = nullptr;
    return made_.compare_exchange_strong(first, made.get(), std::memory_order_acq_rel) ? *made.release() : *first;
  }
  T* take() noexcept { return made_.exchange(nullptr, std::memory_order_relaxed); }

  std::atomic<T*> made_{nullptr};
};

}  // namespace boxstream::detail
