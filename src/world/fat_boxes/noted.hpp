// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/reserve.hpp"
#include "base/thresholds.hpp"
#include "world/state/crew.hpp"

namespace boxstream::detail {

/// A few of many things: threads note them, and then they are visited in their order. Scratch, kept for its memory.
class Noted {
 public:
  static constexpr std::size_t batch = thresholds.portion;
  static_assert(batch % 64 == 0);  // threads must not share words

  /// Room for that many things; may throw.
  void reserve(std::size_t things) {
    words_.clear();
    reserve_more(words_, words_of(things));
  }

  /// Calls `find(first, size, indices)` for batches of the things; it writes which of a batch to note, and returns how
  /// many. Then calls `visit(thing)` for these.
  template <class Find, class Visit>
  void find_and_visit(const Crew& crew, std::size_t things, const Find& find, const Visit& visit) {
    assert(words_of(things) <= words_.capacity());
    const std::size_t parts = crew.parts(things), batches = (things + batch - 1) / batch;
    std::uint32_t indices[batch];
    const auto size_of = [&](std::size_t first) { return std::min(batch, things - first); };
    if (parts == 1) {
      for (std::size_t first = 0; first < things; first += batch)
        for (std::size_t i = 0, count = find(first, size_of(first), indices); i < count; ++i) visit(first + indices[i]);
      return;
    }
    words_.assign(words_of(things), 0);
    const auto note = [&](std::size_t part) {
      std::uint32_t found[batch];
      for (std::size_t b = begin_of_part(batches, part, parts); b < begin_of_part(batches, part + 1, parts); ++b)
        for (std::size_t i = 0, count = find(batch * b, size_of(batch * b), found); i < count; ++i)
          words_[(batch * b + found[i]) / 64] |= std::uint64_t{1} << found[i] % 64;
    };
    crew.run(parts, note);
    for (std::size_t w = 0; w < words_.size(); ++w)
      for (std::uint64_t left = words_[w]; left != 0; left &= left - 1)
        visit(64 * w + static_cast<unsigned>(std::countr_zero(left)));
  }

 private:
  static std::size_t words_of(std::size_t things) { return (things + batch - 1) / batch * (batch / 64); }

  std::vector<std::uint64_t> words_;
};

}  // namespace boxstream::detail
