// SPDX-License-Identifier: MIT
//
// A search of a few boxes. Compiled once per SIMD target; the best one for the machine is picked at run time.

#include <algorithm>
#include <bit>

#include "batch/columns.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/small.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "batch/columns_load-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

// Boxes compared with one other at a time. The same on every target, for it shows in the order of pairs. This many rows
// of their lanes are a word. Of a block's own rows, those before each count.
constexpr std::size_t half_block = block / 2;
constexpr std::uint64_t before_row = 0x7f3f1f0f07030100;
static_assert(half_block * half_block == 64 && half_block * half_block <= PairBuffer::slack);

#if (HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL) && (HWY_TARGETS & HWY_AVX2) != 0

// Of eight boxes at a time: where masks are no vectors, to combine them takes longer than to compare. The targets must
// be those of all units nevertheless: without optimisation, Highway's choice among them is one function for all units.
using N_AVX2::CompareSmall;
using N_AVX2::CompareSmall64;

#else

template <class S>
HWY_INLINE std::uint64_t compare_all(const BasicAabb<S>* boxes, std::size_t size, PairBuffer& pairs) {
  using Key = decltype(order_key(S()));
  const Narrow<Key> d;
  constexpr std::size_t step = hn::MaxLanes(d), vectors_of_half = half_block / step;
  BoxColumnsOf<Key> columns;
  const std::uint64_t valid = load_few(boxes, 0, size, columns);
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
      Pair* out = pairs.end();
      for (; found != 0; found &= found - 1) {
        const auto bit = static_cast<std::size_t>(std::countr_zero(found));
        *out++ = {static_cast<std::uint32_t>(at + bit % half_block),
                  static_cast<std::uint32_t>(first + bit / half_block)};
      }
      pairs.set_end(out);
      if (HWY_UNLIKELY(out >= pairs.limit()) && !pairs.flush()) return valid;
    }
  }
  return valid;
}

HWY_ATTR std::uint64_t CompareSmall(const Aabb* boxes, std::size_t size, PairBuffer& pairs) {
  return compare_all(boxes, size, pairs);
}
HWY_ATTR std::uint64_t CompareSmall64(const Aabb64* boxes, std::size_t size, PairBuffer& pairs) {
  return compare_all(boxes, size, pairs);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(CompareSmall);
HWY_EXPORT(CompareSmall64);

std::uint64_t compare_small(const Aabb* boxes, std::size_t count, PairBuffer& pairs) {
  return HWY_DYNAMIC_DISPATCH(CompareSmall)(boxes, count, pairs);
}

std::uint64_t compare_small(const Aabb64* boxes, std::size_t count, PairBuffer& pairs) {
  return HWY_DYNAMIC_DISPATCH(CompareSmall64)(boxes, count, pairs);
}

}  // namespace boxstream::detail
#endif
