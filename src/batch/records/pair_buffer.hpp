// SPDX-License-Identifier: MIT
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "base/thresholds.hpp"

namespace boxstream::detail {

/// The output of a sweep. The sweep writes at `end()`, at most `slack` pairs beyond `limit()`, and calls
/// `set_end`; once the end has reached `limit()` it calls `flush`. The first batches are small, so that a caller that
/// wants one pair does not wait for thousands.
class PairBuffer {
 public:
  static constexpr std::size_t slack = 64;  // >= the lanes of any SIMD target

  virtual ~PairBuffer() = default;

  /// Marks a pair written as doubtful: its keys overlap, its boxes may not. To be called in the order of pairs.
  void doubt_if(std::size_t one_or_zero, const Pair* pair) {
    assert(doubt_count_ < std::size(doubts_));
    doubts_[doubt_count_] = static_cast<std::uint16_t>(pair - pairs_);
    doubt_count_ += one_or_zero;
  }
  void doubt(const Pair* begin, const Pair* end) {
    for (; begin < end; ++begin) doubt_if(1, begin);
  }

  Pair* end() { return pairs_ + size_; }
  void set_end(Pair* end) {
    assert(end >= pairs_ + size_ && end <= std::end(pairs_));
    size_ = static_cast<std::size_t>(end - pairs_);
  }
  /// At this end and beyond, it has to be flushed.
  const Pair* limit() const { return pairs_ + limit_; }

  bool has_stopped() const { return has_stopped_; }

  /// All pairs ever written, delivered or not; and how many of them were doubtful.
  std::uint64_t found() const { return flushed_ + size_; }
  std::uint64_t doubted() const { return doubts_flushed_ + doubt_count_; }

  /// Delivers the pairs collected so far. False stops the search, and so does each call from then on.
  bool flush() {
    if (size_ == 0 || has_stopped_) return !has_stopped_;
    const std::size_t count = size_;
    size_ = 0;
    flushed_ += count;
    if (limit_ < thresholds.batch) limit_ *= 4;
    has_stopped_ = !take(pairs_, count);
    doubts_flushed_ += doubt_count_;
    doubt_count_ = 0;
    return !has_stopped_;
  }

 protected:
  /// May reorder nothing but drop pairs from `pairs` in place.
  virtual bool take(Pair* pairs, std::size_t count) = 0;

  /// In `take`: which of the pairs are in doubt, ascending.
  Span<const std::uint16_t> doubts() const { return {doubts_, doubt_count_}; }

 private:
  std::size_t size_ = 0;
  std::uint64_t flushed_ = 0, doubts_flushed_ = 0;
  std::size_t limit_ = thresholds.first_batch;
  bool has_stopped_ = false;
  std::size_t doubt_count_ = 0;
  alignas(64) Pair pairs_[thresholds.batch + slack];
  std::uint16_t doubts_[thresholds.batch + slack + 1];
};

}  // namespace boxstream::detail
