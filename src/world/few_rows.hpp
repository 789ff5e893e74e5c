// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include <boxstream/pair.hpp>

#include "base/thresholds.hpp"

namespace boxstream::detail {

/// Pairs of few proxies as a matrix of bits: a row for each first rank, a bit for each second one. So pairs come out in
/// order without being sorted, and to look one up takes no search.
class FewRows {
 public:
  /// As many ranks fit.
  static constexpr std::size_t most = 64 * ((thresholds.few_proxies + 63) / 64);

  /// No pairs of ranks below `ranks`.
  explicit FewRows(std::size_t ranks) : ranks_(ranks), words_((ranks + 63) / 64) {
    assert(ranks <= most);
    for (std::size_t i = 0; i < ranks_ * words_; ++i) bits_[i] = 0;
    for (std::uint64_t& word : filled_) word = 0;
  }

  /// Of a pair (a < b), which may be there already.
  void put(std::uint32_t a, std::uint32_t b) {
    assert(a < b && b < ranks_);
    word(a, b) |= bit(b);
    filled_[a / 64] |= bit(a);
  }

  /// Takes a pair out; returns whether it was there.
  bool take(std::uint32_t a, std::uint32_t b) {
    assert(a < b && b < ranks_);
    std::uint64_t& in = word(a, b);
    const bool has = (in & bit(b)) != 0;
    in &= ~bit(b);
    return has;
  }

  /// Calls `visit(a, b)` in order.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t f = 0; f < words_; ++f)
      for (std::uint64_t rows = filled_[f]; rows != 0; rows &= rows - 1) {
        const std::size_t a = 64 * f + static_cast<unsigned>(std::countr_zero(rows));
        for (std::size_t w = a / 64; w < words_; ++w)
          for (std::uint64_t left = bits_[a * words_ + w]; left != 0; left &= left - 1)
            visit(static_cast<std::uint32_t>(a),
                  static_cast<std::uint32_t>(64 * w) + static_cast<std::uint32_t>(std::countr_zero(left)));
      }
  }

 private:
  static std::uint64_t bit(std::uint32_t rank) { return std::uint64_t{1} << rank % 64; }
  std::uint64_t& word(std::uint32_t a, std::uint32_t b) { return bits_[a * words_ + b / 64]; }

  std::size_t ranks_, words_;        // a row takes so many words
  std::uint64_t filled_[most / 64];  // rows that have had a pair
  std::uint64_t bits_[most * most / 64];
};

}  // namespace boxstream::detail
