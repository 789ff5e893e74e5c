// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/pair.hpp>

namespace boxstream::detail {

/// Where the sweep leaves what it finds. The sweep writes at `end()`, at most `slack` pairs beyond `limit()`, and calls
/// `set_end`; once the end has reached `limit()` it calls `flush`. The first batches are small, so that a caller who
/// wants one pair does not wait for thousands.
class PairBuffer {
 public:
  static constexpr std::size_t capacity = 1024;  // 8 KiB: stays in L1, and on a small stack
  static constexpr std::size_t slack = 64;       // >= the lanes of any SIMD target

  virtual ~PairBuffer() = default;

  Pair* end() { return pairs_ + size_; }
  void set_end(Pair* end) { size_ = static_cast<std::size_t>(end - pairs_); }
  /// At this end and beyond, it has to be flushed.
  const Pair* limit() const { return pairs_ + limit_; }

  /// Pairs that were ever written, whatever became of them.
  std::uint64_t found() const { return flushed_ + size_; }

  /// Hands over what is there; false when the search is to stop.
  bool flush() {
    if (size_ == 0) return true;
    const std::size_t count = size_;
    size_ = 0;
    flushed_ += count;
    if (limit_ < capacity) limit_ *= 4;
    return take(pairs_, count);
  }

 protected:
  /// May reorder nothing but drop pairs from `pairs` in place.
  virtual bool take(Pair* pairs, std::size_t count) = 0;

 private:
  std::size_t size_ = 0;
  std::uint64_t flushed_ = 0;
  std::size_t limit_ = 64;
  alignas(64) Pair pairs_[capacity + slack];
};

}  // namespace boxstream::detail
