// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace boxstream::detail {

/// Memory for the vectors of one object that lies in the object itself, so that a small one needs no other. What fits
/// comes from here, in the order in which it is asked for; the rest from the heap. When all has been given back it is
/// free again as a whole.
template <std::size_t size>
class FirstBlock {
 public:
  FirstBlock() = default;
  FirstBlock(const FirstBlock&) = delete;
  FirstBlock& operator=(const FirstBlock&) = delete;

  /// Null if it does not fit.
  void* take(std::size_t bytes, std::size_t alignment) noexcept {
    const std::size_t at = (used_ + alignment - 1) / alignment * alignment;
    if (at > size || bytes > size - at) return nullptr;
    used_ = at + bytes;
    ++taken_;
    return memory_ + at;
  }
  /// False if it is from the heap.
  bool give_back(const void* memory) noexcept {
    const std::less<const void*> before;
    if (before(memory, memory_) || !before(memory, memory_ + size)) return false;
    if (--taken_ == 0) used_ = 0;
    return true;
  }

  /// For vectors of the object.
  template <class T>
  class Allocator {
   public:
    using value_type = T;
    template <class U>
    struct rebind {
      using other = Allocator<U>;
    };

    explicit Allocator(FirstBlock& block) noexcept : block_(&block) {}
    template <class U>
    Allocator(const Allocator<U>& other) noexcept : block_(other.block()) {}

    T* allocate(std::size_t count) {
      if (void* const memory = block_->take(count * sizeof(T), alignof(T))) return static_cast<T*>(memory);
      return std::allocator<T>().allocate(count);
    }
    void deallocate(T* memory, std::size_t count) noexcept {
      if (!block_->give_back(memory)) std::allocator<T>().deallocate(memory, count);
    }

    FirstBlock* block() const noexcept { return block_; }
    friend bool operator==(const Allocator& x, const Allocator& y) { return x.block_ == y.block_; }

   private:
    FirstBlock* block_;
  };

 private:
  alignas(std::max_align_t) std::byte memory_[size];
  std::size_t used_ = 0, taken_ = 0;
};

}  // namespace boxstream::detail
