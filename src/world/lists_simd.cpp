// SPDX-License-Identifier: MIT
#include "world/lists_simd.hpp"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/lists_simd.cpp"
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

/// Copies those of `count` pairs, a vector at most, that have no bit in `gone`, and returns how many they are.
HWY_INLINE std::size_t keep(const std::uint32_t* HWY_RESTRICT firsts, const std::uint32_t* HWY_RESTRICT seconds,
                            std::size_t count, std::uint64_t gone, std::uint32_t* HWY_RESTRICT next_firsts,
                            std::uint32_t* HWY_RESTRICT next_seconds) {
  const Ranks d;
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL
  // Not CompressStore: some processors take a hundred cycles for the instruction behind it.
  std::uint8_t bits[8];
  const std::uint64_t kept = gone ^ ((std::uint64_t{1} << count) - 1);
  std::memcpy(bits, &kept, sizeof(bits));
  const auto mask = hn::LoadMaskBits(d, bits);
  hn::StoreU(hn::Compress(hn::LoadU(d, firsts), mask), d, next_firsts);
  hn::StoreU(hn::Compress(hn::LoadU(d, seconds), mask), d, next_seconds);
  return hn::CountTrue(d, mask);
#else
  if (gone == 0) {
    hn::StoreU(hn::LoadU(d, firsts), d, next_firsts);
    hn::StoreU(hn::LoadU(d, seconds), d, next_seconds);
    return count;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    next_firsts[kept] = firsts[i];
    next_seconds[kept] = seconds[i];
    kept += (gone >> i & 1) == 0;
  }
  return kept;
#endif
}

HWY_ATTR void Exchange(const std::uint32_t* HWY_RESTRICT firsts, const std::uint32_t* HWY_RESTRICT seconds,
                       std::size_t size, const std::uint32_t* HWY_RESTRICT starts,
                       const std::uint64_t* HWY_RESTRICT is_gone, const PairKey* HWY_RESTRICT added,
                       std::size_t added_count, std::uint32_t* HWY_RESTRICT next_firsts,
                       std::uint32_t* HWY_RESTRICT next_seconds) {
  const Ranks d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t done = 0;
  std::size_t out = 0;
  const auto keep_until = [&](std::size_t end) HWY_ATTR {
    while (done < end) {
      const std::size_t count = std::min({lanes, end - done, 64 - done % 64});
      const std::uint64_t gone = is_gone[done / 64] >> done % 64 & ((std::uint64_t{1} << count) - 1);
      out += keep(firsts + done, seconds + done, count, gone, next_firsts + out, next_seconds + out);
      done += count;
    }
  };
  for (std::size_t i = 0; i < added_count; ++i) {
    const std::uint32_t a = first_of(added[i]);
    const std::uint32_t b = second_of(added[i]);
    if (done < size) {
      const Part part = part_with(b, seconds, starts[a], starts[a + 1] - starts[a], lanes);
      const auto before = hn::And(hn::FirstN(d, part.length), hn::Lt(hn::LoadU(d, seconds + part.at), hn::Set(d, b)));
      keep_until(part.at + hn::CountTrue(d, before));
    }
    next_firsts[out] = a;
    next_seconds[out] = b;
    ++out;
  }
  keep_until(size);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Confirm);
HWY_EXPORT(Exchange);

std::size_t confirm_pairs(Span<const Pair> found, const std::uint32_t* starts, const std::uint32_t* seconds,
                          std::uint64_t* expected, Pair* fresh) {
  return HWY_DYNAMIC_DISPATCH(Confirm)(found.data(), found.size(), starts, seconds, expected, fresh);
}

void exchange_pairs(const PairColumns& pairs, std::size_t size, const std::uint32_t* starts,
                    const std::uint64_t* is_gone, Span<const PairKey> added, PairColumns& next) {
  HWY_DYNAMIC_DISPATCH(Exchange)
  (pairs.first.data(), pairs.second.data(), size, starts, is_gone, added.data(), added.size(), next.first.data(),
   next.second.data());
}

}  // namespace boxstream::detail
#endif
