// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "world/state/few_boxes.hpp"
#include "world/state/lists.hpp"

namespace boxstream::detail {

/// The pairs that few proxies hold, as bits: a row for each rank, with a bit for each other one. So what is found is
/// compared with what is held word by word.
class FewRows {
 public:
  /// Of these pairs in this edition of theirs, unless the rows are that already. May throw.
  void follow(const PairLists& pairs, std::uint64_t edition, std::size_t ranks) {
    if (edition == edition_ && ranks <= ranks_) return;
    edition_ = 0;
    ranks_ = (ranks + least_ranks - 1) / least_ranks * least_ranks;
    bits_.assign(ranks_ * bit_words(ranks_), 0);
    pairs.for_each([this](PairKey key) {
      flip(key);
      return true;
    });
    edition_ = edition;
  }
  /// What began or ended leads to another edition.
  void flip(PairKey key) noexcept {
    flip(first_of(key), second_of(key));
    flip(second_of(key), first_of(key));
  }
  void follow(std::uint64_t edition) noexcept { edition_ = edition; }
  /// Gives memory back.
  void drop() noexcept {
    edition_ = 0;
    std::vector<std::uint64_t>().swap(bits_);
    ranks_ = 0;
  }

  const std::uint64_t* row(std::uint32_t rank) const {
    assert(rank < ranks_);
    return bits_.data() + rank * bit_words(ranks_);
  }

 private:
  static constexpr std::size_t least_ranks = 16;

  void flip(std::uint32_t rank, std::uint32_t other) noexcept {
    assert(rank < ranks_ && other < ranks_);
    bits_[rank * bit_words(ranks_) + other / 64] ^= std::uint64_t{1} << other % 64;
  }

  std::uint64_t edition_ = 0;  // of no pairs
  std::size_t ranks_ = 0;
  std::vector<std::uint64_t> bits_;
};

}  // namespace boxstream::detail
