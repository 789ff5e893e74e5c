// SPDX-License-Identifier: MIT
//
// Rows of neighbours. Compiled once per SIMD target; the best one for the machine is picked at run time.

#include "batch/neighbours.hpp"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/neighbours.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// The place of each number is how many are less, which is counted for all of them up to this many: without branches,
// for what they would depend on is unpredictable.
constexpr std::size_t most_counted = 96;

HWY_INLINE void sort_by_counts(std::uint32_t* row, std::size_t size) {
  using D = hn::CappedTag<std::uint32_t, 16>;
  constexpr std::size_t lanes = hn::MaxLanes(D());
  const D d;
  alignas(64) std::uint32_t numbers[most_counted + lanes], places[most_counted + lanes];
  std::copy_n(row, size, numbers);
  std::fill_n(numbers + size, lanes, 0u);
  for (std::size_t at = 0; at < size; at += lanes) {
    const auto these = hn::Load(d, numbers + at);
    auto less = hn::Zero(d);
    for (std::size_t i = 0; i < size; ++i)
      less = hn::Sub(less, hn::VecFromMask(d, hn::Lt(hn::Set(d, numbers[i]), these)));
    hn::Store(less, d, places + at);
  }
  for (std::size_t i = 0; i < size; ++i) row[places[i]] = numbers[i];
}

/// Of 2 to 4 numbers, as most rows have where boxes meet few others.
HWY_INLINE void sort_few(std::uint32_t* row, std::size_t size) {
  const auto order = [row](std::size_t i, std::size_t j) {
    const std::uint32_t x = row[i], y = row[j];
    row[i] = std::min(x, y);
    row[j] = std::max(x, y);
  };
  if (size == 4) {
    order(0, 1);
    order(2, 3);
    order(0, 2);
    order(1, 3);
    order(1, 2);
    return;
  }
  order(0, 1);
  if (size == 2) return;
  order(1, 2);
  order(0, 1);
}

HWY_ATTR void SortRows(Neighbours& rows, std::size_t first, std::size_t last) {
  std::uint32_t* const indices = rows.indices.data();
  for (std::size_t i = first; i < last; ++i) {
    const auto begin = static_cast<std::size_t>(rows.offsets[i]);
    const std::size_t size = static_cast<std::size_t>(rows.offsets[i + 1]) - begin;
    if (size < 2) continue;
    if (size <= 4)
      sort_few(indices + begin, size);
    else if (size <= most_counted)
      sort_by_counts(indices + begin, size);
    else
      std::sort(indices + begin, indices + begin + size);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(SortRows);

void sort_rows(Neighbours& rows, std::size_t first, std::size_t last) {
  HWY_DYNAMIC_DISPATCH(SortRows)(rows, first, last);
}

void NeighbourRows::fill() {
  std::uint64_t sum = 0;
  std::uint64_t* const ends = out_.offsets.data() + 1;
  for (std::size_t i = 0; i + 1 < out_.offsets.size(); ++i) {
    const std::uint64_t count = ends[i];
    ends[i] = sum;
    sum += count;
  }
  out_.indices.resize(static_cast<std::size_t>(sum));
  std::uint32_t* const indices = out_.indices.data();
  for (std::size_t p = 0, left = size_; left != 0; ++p) {
    const Pair *pair = pieces_[p].get(), *const end = pair + std::min(left, piece);
    left -= static_cast<std::size_t>(end - pair);
    if (both_) {
      for (; pair != end; ++pair) {
        indices[ends[pair->a]++] = pair->b;
        indices[ends[pair->b]++] = pair->a;
      }
    } else {
      for (; pair != end; ++pair) indices[ends[pair->a]++] = pair->b;
    }
  }
}

}  // namespace boxstream::detail
#endif
