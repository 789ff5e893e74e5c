// SPDX-License-Identifier: MIT
#include "late_splice.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

/// They are pointers, whatever their copy constructor is.
void copy(btBroadphasePair* to, const btBroadphasePair* from, std::size_t count) {
  std::memmove(static_cast<void*>(to), static_cast<const void*>(from), count * sizeof(*to));
}

}  // namespace

std::size_t LateSplice::begin(const Splice& changes, const btBroadphasePair* arriving, std::size_t size) {
  carried_.resize(block + changes.inserted.size());
  removed_.reserve(changes.removed.size());
  inserted_.reserve(changes.inserted.size());
  arriving_.reserve(changes.inserted.size());
  removed_.assign(changes.removed.begin(), changes.removed.end());
  inserted_.assign(changes.inserted.begin(), changes.inserted.end());
  arriving_.assign(arriving, arriving + inserted_.size());
  size_ = size;
  less_ = more_ = 0;
  next_ = size;
  if (!removed_.empty()) next_ = std::min<std::size_t>(next_, removed_.front());
  if (!inserted_.empty()) next_ = std::min<std::size_t>(next_, inserted_.front());
  read_ = next_;
  first_carried_ = 0;
  return next_;
}

std::size_t LateSplice::go_on(btBroadphasePair* pairs, std::size_t done, std::size_t end) noexcept {
  while (done < end) {
    const bool has_ended = less_ == removed_.size() && more_ == inserted_.size() && next_ == done;
    if (has_ended) return next_size();
    const std::size_t block_end = std::min(done + block, next_size());
    carry(pairs, block_end);
    place(pairs, done, block_end);
    done = block_end;
  }
  return done;
}

/// The old pairs before `end`, as new ones are about to come there.
void LateSplice::carry(const btBroadphasePair* pairs, std::size_t end) noexcept {
  end = std::min(end, size_);
  if (read_ >= end) return;
  const std::size_t carried = read_ - next_, more = end - read_;
  assert(carried + more <= carried_.size());
  copy(carried_.data(), carried_.data() + first_carried_, carried);
  copy(carried_.data() + carried, pairs + read_, more);
  first_carried_ = 0;
  read_ = end;
}

void LateSplice::place(btBroadphasePair* pairs, std::size_t begin, std::size_t end) noexcept {
  while (begin < end) {
    const bool is_carried = next_ < read_;
    std::size_t count = 1;
    if (more_ < inserted_.size() && inserted_[more_] == begin) {
      pairs[begin++] = arriving_[more_++];
      continue;
    }
    const bool goes = less_ < removed_.size() && removed_[less_] == next_;
    if (goes) {
      ++less_;
    } else {
      count = (is_carried ? read_ : size_) - next_;
      if (less_ < removed_.size()) count = std::min(count, removed_[less_] - next_);
      if (more_ < inserted_.size()) count = std::min(count, inserted_[more_] - begin);
      count = std::min(count, end - begin);
      copy(pairs + begin, is_carried ? carried_.data() + first_carried_ : pairs + next_, count);
      begin += count;
    }
    next_ += count;
    (is_carried ? first_carried_ : read_) += count;
  }
}

void LateSplice::give_back() noexcept {
  std::vector<std::uint32_t>().swap(removed_);
  std::vector<std::uint32_t>().swap(inserted_);
  std::vector<btBroadphasePair>().swap(arriving_);
  std::vector<btBroadphasePair>().swap(carried_);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
