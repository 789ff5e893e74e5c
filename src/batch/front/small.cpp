// SPDX-License-Identifier: MIT
//
// A search of a few boxes. Compiled once per SIMD target; the best one for the machine is picked at run time.

#include <algorithm>
#include <bit>
#include <cassert>

#include "batch/records/columns.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/front/small.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "batch/front/small_bytes-inl.hpp"
#include "batch/front/small_sets-inl.hpp"
#include "batch/records/columns_load-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

// Half a block is compared with one other box at a time. That many rows of its lanes are a word. Of a block's own rows,
// those before each count.
constexpr std::uint64_t before_row = 0x7f3f1f0f07030100;
static_assert(half_block * half_block == 64 && half_block * half_block <= PairBuffer::slack);

#if (HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL) && (HWY_TARGETS & HWY_AVX2) != 0

// Of eight boxes at a time: where masks are no vectors, to combine them takes longer than to compare. The targets must
// be those of all units nevertheless: without optimisation, Highway's choice among them is one function for all units.
using N_AVX2::CompareSmall;
using N_AVX2::CompareSmall64;
using N_AVX2::CompareTiny;
using N_AVX2::CompareTiny64;

#else

/// Compares all with all at full precision.
template <class Key>
HWY_INLINE void compare_all(const SmallColumns<Key>& columns, std::size_t size, std::uint32_t first_id,
                            PairBuffer& pairs) {
  const Narrow<Key> d;
  constexpr std::size_t step = hn::MaxLanes(d), vectors_of_half = half_block / step;
  for (std::size_t at = 0; at < size; at += half_block) {
    Bounds<Narrow<Key> > many[vectors_of_half], one;
    for (std::size_t k = 0; k < vectors_of_half; ++k) many[k].load(columns, at + k * step);
    for (std::size_t first = at; first < size; first += half_block) {
      const std::size_t rows = std::min(half_block, size - first);
      std::uint64_t found = 0;
      for (std::size_t r = 0; r < rows; ++r) {
        one.repeat(columns, first + r);
        std::uint64_t disjoint = 0;
        for (std::size_t k = 0; k < vectors_of_half; ++k)
          disjoint |= std::uint64_t{bits_of(d, one.disjoint(many[k]))} << (k * step);
        found |= (disjoint ^ ((1u << half_block) - 1)) << (r * half_block);
      }
      if (first == at) found &= before_row;
      // Most words have few bits: that many pairs are written whether there are as many or not, for how many there are
      // is unpredictable.
      constexpr std::size_t eager = 3;
      Pair* const out = pairs.end();
      const auto count = static_cast<std::size_t>(std::popcount(found));
      const auto write_next = [&](Pair& pair) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(found));
        pair = {first_id + static_cast<std::uint32_t>(at + bit % half_block),
                first_id + static_cast<std::uint32_t>(first + bit / half_block)};
        found &= found - 1;
      };
      for (std::size_t i = 0; i < eager; ++i) write_next(out[i]);
      for (std::size_t i = eager; i < count; ++i) write_next(out[i]);
      pairs.set_end(out + count);
      if (HWY_UNLIKELY(out + count >= pairs.limit()) && !pairs.flush()) return;
    }
  }
}

template <class S>
HWY_INLINE std::size_t compare_set(const BasicAabb<S>* boxes, std::size_t size, Faces faces, std::uint32_t first_id,
                                   PairBuffer& pairs) {
  using Key = decltype(order_key(S()));
  constexpr std::size_t step = hn::MaxLanes(Narrow<Key>());
  SmallColumns<Key> columns;
  std::size_t valid = 0;
  for (std::size_t at = 0; at < size; at += step)
    valid +=
        static_cast<std::size_t>(std::popcount(load_some(boxes + at, std::min(step, size - at), at, faces, columns)));
  if (size <= thresholds.most_at_once)
    compare_all(columns, size, first_id, pairs);
  else
    compare_by_bytes(columns, size, first_id, pairs);
  return valid;
}

HWY_ATTR std::size_t CompareSmall(const Aabb* boxes, std::size_t size, Faces faces, std::uint32_t first_id,
                                  PairBuffer& pairs) {
  return compare_set(boxes, size, faces, first_id, pairs);
}
HWY_ATTR std::size_t CompareSmall64(const Aabb64* boxes, std::size_t size, Faces faces, std::uint32_t first_id,
                                    PairBuffer& pairs) {
  return compare_set(boxes, size, faces, first_id, pairs);
}

HWY_ATTR void CompareTiny(const Aabb* boxes, const std::uint64_t* offsets, std::size_t sets, Faces faces,
                          PairBuffer& pairs, TinyCounts& counts) {
  compare_tiny_sets(boxes, offsets, sets, faces, pairs, counts);
}
HWY_ATTR void CompareTiny64(const Aabb64* boxes, const std::uint64_t* offsets, std::size_t sets, Faces faces,
                            PairBuffer& pairs, TinyCounts& counts) {
  compare_tiny_sets(boxes, offsets, sets, faces, pairs, counts);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(CompareSmall);
HWY_EXPORT(CompareSmall64);
HWY_EXPORT(CompareTiny);
HWY_EXPORT(CompareTiny64);

std::size_t compare_small(const Aabb* boxes, std::size_t count, Faces faces, std::uint32_t first_id,
                          PairBuffer& pairs) {
  assert(count <= thresholds.most_small);
  return HWY_DYNAMIC_DISPATCH(CompareSmall)(boxes, count, faces, first_id, pairs);
}

std::size_t compare_small(const Aabb64* boxes, std::size_t count, Faces faces, std::uint32_t first_id,
                          PairBuffer& pairs) {
  assert(count <= thresholds.most_small);
  return HWY_DYNAMIC_DISPATCH(CompareSmall64)(boxes, count, faces, first_id, pairs);
}

void compare_tiny(const Aabb* boxes, const std::uint64_t* offsets, std::size_t sets, Faces faces, PairBuffer& pairs,
                  TinyCounts& counts) {
  HWY_DYNAMIC_DISPATCH(CompareTiny)(boxes, offsets, sets, faces, pairs, counts);
}

void compare_tiny(const Aabb64* boxes, const std::uint64_t* offsets, std::size_t sets, Faces faces, PairBuffer& pairs,
                  TinyCounts& counts) {
  HWY_DYNAMIC_DISPATCH(CompareTiny64)(boxes, offsets, sets, faces, pairs, counts);
}

}  // namespace boxstream::detail
#endif
