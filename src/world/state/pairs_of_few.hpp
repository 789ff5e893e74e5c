// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "world/state/pairs.hpp"

namespace boxstream::detail {

/// The pairs that few ranks hold, by themselves: an update of these looks at no other, and changes none.
class PairsOfFew {
 public:
  /// May throw.
  void expect(const HeldPairs& held, Span<const std::uint32_t> ranks) {
    expected_.clear();
    for (const std::uint32_t rank : ranks) held.for_each_of(rank, [this](PairKey key) { expected_.push_back(key); });
    std::sort(expected_.begin(), expected_.end());
    expected_.erase(std::unique(expected_.begin(), expected_.end()), expected_.end());
    is_found_.assign(expected_.size(), false);
  }

  /// Pairs that were found, of these ranks: those that are not held are appended to `fresh`. May throw.
  void confirm(Span<const Pair> found, std::vector<Pair>& fresh) {
    for (const Pair pair : found) {
      const PairKey key = pair_key(pair.a, pair.b);
      const auto at = std::lower_bound(expected_.begin(), expected_.end(), key);
      if (at != expected_.end() && *at == key)
        is_found_[static_cast<std::size_t>(at - expected_.begin())] = true;
      else
        fresh.push_back(pair);
    }
  }

  /// As PairLists::find_missing.
  template <class IsGone>
  void find_missing(const HeldPairs& held, IsGone&& is_gone, std::vector<std::uint32_t>& gone) const {
    gone.clear();
    for (std::size_t i = 0; i < expected_.size(); ++i)
      if (!is_found_[i] && is_gone(expected_[i])) gone.push_back(static_cast<std::uint32_t>(held.place(expected_[i])));
  }

  void give_back() noexcept {
    std::vector<PairKey>().swap(expected_);
    std::vector<std::uint8_t>().swap(is_found_);
  }

 private:
  std::vector<PairKey> expected_;
  std::vector<std::uint8_t> is_found_;
};

}  // namespace boxstream::detail
