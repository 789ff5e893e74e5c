// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/bits.hpp"
#include "base/reserve.hpp"
#include "base/thresholds.hpp"
#include "world/state/update_threads.hpp"

namespace boxstream::detail {

/// Indices that threads select in parallel, and that are then visited in order. Kept between updates for its memory.
class Selection {
 public:
  static constexpr std::size_t batch = thresholds.portion;
  static_assert(batch % 64 == 0);  // threads must not share words

  /// Room to select among that many elements; may throw.
  void reserve(std::size_t elements) {
    words_.clear();
    reserve_more(words_, words_of(elements));
  }

  /// Calls `find(first, size, indices)` for batches of the elements; it writes the selected ones of a batch, counted
  /// from `first`, and returns how many. Then calls `visit(index)` for each.
  template <class Find, class Visit>
  void find_and_visit(const UpdateThreads& threads, std::size_t elements, const Find& find, const Visit& visit) {
    assert(words_of(elements) <= words_.capacity());
    const std::size_t parts = threads.parts(elements), batches = (elements + batch - 1) / batch;
    std::uint32_t indices[batch];
    const auto size_of = [&](std::size_t first) { return std::min(batch, elements - first); };
    if (parts == 1) {
      for (std::size_t first = 0; first < elements; first += batch)
        for (std::size_t i = 0, count = find(first, size_of(first), indices); i < count; ++i) visit(first + indices[i]);
      return;
    }
    words_.assign(words_of(elements), 0);
    const auto select = [&](std::size_t part) {
      std::uint32_t found[batch];
      for (std::size_t b = begin_of_part(batches, part, parts); b < begin_of_part(batches, part + 1, parts); ++b)
        for (std::size_t i = 0, count = find(batch * b, size_of(batch * b), found); i < count; ++i)
          words_[(batch * b + found[i]) / 64] |= std::uint64_t{1} << found[i] % 64;
    };
    threads.run(parts, select);
    for (std::size_t w = 0; w < words_.size(); ++w) for_each_bit(words_[w], [&](unsigned bit) { visit(64 * w + bit); });
  }

 private:
  static std::size_t words_of(std::size_t elements) { return (elements + batch - 1) / batch * (batch / 64); }

  std::vector<std::uint64_t> words_;
};

}  // namespace boxstream::detail
