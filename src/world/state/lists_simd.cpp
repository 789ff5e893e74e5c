// SPDX-License-Identifier: MIT
#include "world/state/lists_simd.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/state/lists_simd.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Narrower ones cross fewer cache lines, but halve the long lists of large boxes once more.
using Ranks = hn::CappedTag<std::uint32_t, 16>;

/// A part of a list that fits a vector, and where a rank would be in the list if it is not in this part.
struct Part {
  std::size_t at;
  std::size_t length;
};

/// Most lists fit as they are. Longer ones are halved until they do. There are no branches to mispredict, so that pairs
/// that come one after the other do not wait for each other.
HWY_INLINE Part part_with(std::uint32_t rank, const std::uint32_t* HWY_RESTRICT seconds, std::size_t at,
                          std::size_t length, std::size_t lanes) {
  while (length > lanes) {
    const std::size_t half = length / 2;
    at += seconds[at + half] <= rank ? half : 0;
    length -= half;
  }
  return {at, length};
}

HWY_ATTR std::size_t Confirm(const Pair* HWY_RESTRICT found, std::size_t count,
                             const std::uint32_t* HWY_RESTRICT starts, const std::uint32_t* HWY_RESTRICT seconds,
                             std::uint64_t* HWY_RESTRICT expected, Pair* HWY_RESTRICT fresh) {
  const Ranks d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t fresh_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = found[i];
    const std::size_t start = starts[pair.a];
    const Part part = part_with(pair.b, seconds, start, starts[pair.a + 1] - start, lanes);
    const auto equal = hn::And(hn::FirstN(d, part.length), hn::Eq(hn::LoadU(d, seconds + part.at), hn::Set(d, pair.b)));
    const auto lane = hn::FindFirstTrue(d, equal);
    const bool is_held = lane >= 0;
    const std::size_t bit = part.at + static_cast<std::size_t>(is_held ? lane : 0);
    expected[bit / 64] &= ~(std::uint64_t{is_held} << bit % 64);
    fresh[fresh_count] = pair;
    fresh_count += !is_held;
  }
  return fresh_count;
}

HWY_ATTR void Places(const PairKey* HWY_RESTRICT pairs, std::size_t count, const std::uint32_t* HWY_RESTRICT starts,
                     const std::uint32_t* HWY_RESTRICT seconds, std::uint32_t* HWY_RESTRICT places) {
  const Ranks d;
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t a = first_of(pairs[i]), b = second_of(pairs[i]);
    const Part part = part_with(b, seconds, starts[a], starts[a + 1] - starts[a], lanes);
    const auto before = hn::And(hn::FirstN(d, part.length), hn::Lt(hn::LoadU(d, seconds + part.at), hn::Set(d, b)));
    places[i] = static_cast<std::uint32_t>(part.at + hn::CountTrue(d, before));
  }
}

/// Nearly all groups of 64 have none.
HWY_ATTR std::size_t GroupWith(const std::uint32_t* HWY_RESTRICT ranks, std::size_t group, std::size_t groups,
                               std::uint32_t rank) {
  const Ranks d;
  const std::size_t lanes = hn::Lanes(d);
  const auto wanted = hn::Set(d, rank);
  for (; group < groups; ++group) {
    const std::uint32_t* const some = ranks + 64 * group;
    auto nearest = hn::Xor(hn::LoadU(d, some), wanted);
    for (std::size_t i = lanes; i < 64; i += lanes) nearest = hn::Min(nearest, hn::Xor(hn::LoadU(d, some + i), wanted));
    if (!hn::AllFalse(d, hn::Eq(nearest, hn::Zero(d)))) break;
  }
  return group;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Confirm);
HWY_EXPORT(Places);
HWY_EXPORT(GroupWith);

std::size_t confirm_pairs(Span<const Pair> found, const std::uint32_t* starts, const std::uint32_t* seconds,
                          std::uint64_t* expected, Pair* fresh) {
  return HWY_DYNAMIC_DISPATCH(Confirm)(found.data(), found.size(), starts, seconds, expected, fresh);
}

void find_places(Span<const PairKey> pairs, const std::uint32_t* starts, const std::uint32_t* seconds,
                 std::uint32_t* places) {
  HWY_DYNAMIC_DISPATCH(Places)(pairs.data(), pairs.size(), starts, seconds, places);
}

std::size_t group_with(const std::uint32_t* ranks, std::size_t first, std::size_t groups, std::uint32_t rank) {
  return HWY_DYNAMIC_DISPATCH(GroupWith)(ranks, first, groups, rank);
}

}  // namespace boxstream::detail
#endif
