// SPDX-License-Identifier: MIT
//
// How boxes are brought to the cells of a grid. Compiled once per SIMD target; the best one for the machine is picked
// at run time.

#include "batch/cuts/cells.hpp"

#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/cuts/cells.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "batch/records/quadruples-inl.hpp"
#include "batch/records/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

// Vectors of boxes that are looked up together, by their low and their high ends: so boundaries are read once for all.
constexpr std::size_t together = 2, keys_together = 2 * together;
static_assert(load_block % (together * lanes) == 0);

/// How many of the boundaries are below each key: of the groups' ends first, then of one group's.
HWY_INLINE void find_slabs(const V (&keys)[keys_together], const Slabs& slabs, V (&found)[keys_together]) {
  const D d;
  const auto count_beyond = [&](std::size_t k, V boundary) HWY_ATTR {
    found[k] = hn::Sub(found[k], hn::VecFromMask(d, hn::Gt(keys[k], boundary)));
  };
  for (V& slab : found) slab = hn::Zero(d);
  if constexpr (lanes >= Slabs::groups) {
    const unsigned last = slabs.per_group - 1, most = (slabs.count - 1) / slabs.per_group;
    const std::int32_t* const ends = slabs.keys(last);
    for (unsigned g = 0; g < most; ++g) {
      const auto boundary = hn::Set(d, ends[g]);
      for (std::size_t k = 0; k < keys_together; ++k) count_beyond(k, boundary);
    }
    decltype(hn::IndicesFromVec(d, found[0])) groups[keys_together];
    for (std::size_t k = 0; k < keys_together; ++k) {
      groups[k] = hn::IndicesFromVec(d, found[k]);
      found[k] = hn::Mul(found[k], hn::Set(d, static_cast<std::int32_t>(slabs.per_group)));
    }
    for (unsigned i = 0; i < last; ++i) {
      const auto boundaries = hn::LoadU(d, slabs.keys(i));
      for (std::size_t k = 0; k < keys_together; ++k) count_beyond(k, hn::TableLookupLanes(boundaries, groups[k]));
    }
  } else {
    for (unsigned i = 0; i < slabs.per_group * Slabs::groups; ++i) {
      const auto boundary = hn::Set(d, slabs.keys(0)[i]);
      for (std::size_t k = 0; k < keys_together; ++k) count_beyond(k, boundary);
    }
  }
}

/// In which slabs records begin, and how many further ones they reach.
struct Reach {
  VU first[together], more[together];

  HWY_INLINE Reach() {
    for (std::size_t k = 0; k < together; ++k) first[k] = more[k] = hn::Zero(DU());
  }
  HWY_INLINE void find(const V (&lo)[4][together], const V (&hi)[4][together], const Slabs& slabs) {
    V keys[keys_together], found[keys_together];
    for (std::size_t k = 0; k < together; ++k) {
      keys[k] = lo[slabs.axis][k];
      // A flat open box ends before it begins, and is where it begins.
      keys[together + k] = hn::Max(keys[k], hi[slabs.axis][k]);
    }
    find_slabs(keys, slabs, found);
    for (std::size_t k = 0; k < together; ++k) {
      first[k] = hn::BitCast(DU(), found[k]);
      more[k] = hn::BitCast(DU(), hn::Sub(found[together + k], found[k]));
    }
  }
};

/// The cache line may be in another core's cache, from an earlier search: fetching it for reading and then again for
/// writing would take several times as long.
HWY_INLINE void prefetch_to_write([[maybe_unused]] void* at) {
#if HWY_ARCH_X86 && (HWY_COMPILER_GCC || HWY_COMPILER_CLANG)
  // The builtin means another instruction unless the target is said to have this one; those without ignore it.
  __asm__ __volatile__("prefetchw %0" : : "m"(*static_cast<char*>(at)));
#elif HWY_COMPILER_GCC || HWY_COMPILER_CLANG
  __builtin_prefetch(at, 1);
#else
  hwy::Prefetch(at);
#endif
}

/// Calls visit(i) for each bit i. That of base/bits.hpp is compiled for no target, so it would not be inlined here.
template <class Visit>
HWY_INLINE void for_each_bit(std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<unsigned>(std::countr_zero(bits)));
}

/// Calls visit(rows, columns) for the cells that a box touches, except the first and its neighbours.
template <class Visit>
HWY_INLINE void for_each_further(Place place, const Visit& visit) {
  for (unsigned row = 0; row <= place.more_rows(); ++row)
    for (unsigned column = row < 2 ? 2 - row : 0; column <= place.more_columns(); ++column) visit(row, column);
}

HWY_ATTR Crossings Locate(const Record* HWY_RESTRICT records, std::size_t count, std::uint64_t valid, const Grid& grid,
                          Place* HWY_RESTRICT places, std::uint32_t* HWY_RESTRICT counts) {
  const bool has_columns = grid.columns.count > 1;
  const DU d;
  const auto columns = hn::Set(d, grid.columns.count), large = hn::Set(d, grid.large()), zero = hn::Zero(d);
  const auto most_crossed = hn::Set(d, grid.rows.most_crossed), one = hn::Set(d, 1u);
  Crossings crossings;
  for (std::size_t begin = 0; begin < load_block; begin += together * lanes) {
    V lo[4][together], hi[4][together];
    for (std::size_t k = 0; k < together; ++k) {
      V words[4];
      load_columns_of(D(), records + begin + k * lanes, SIZE_MAX, 0, words);
      for (int axis = 0; axis < 3; ++axis) lo[axis][k] = words[axis];
      load_columns_of(D(), records + begin + k * lanes, SIZE_MAX, 4, words);
      for (int axis = 0; axis < 3; ++axis) hi[axis][k] = words[axis];
    }
    Reach down, across;
    down.find(lo, hi, grid.rows);
    if (has_columns) across.find(lo, hi, grid.columns);
    for (std::size_t k = 0; k < together; ++k) {
      const std::size_t i = begin + k * lanes;
      const auto is_large = hn::Gt(down.more[k], most_crossed);
      auto cell = down.first[k], more_columns = zero;
      if (has_columns) {
        more_columns = hn::IfThenZeroElse(is_large, across.more[k]);
        cell = hn::Add(hn::Mul(cell, columns), across.first[k]);
        crossings.column |= std::uint64_t{bits_of(d, hn::Gt(more_columns, zero))} << i;
      }
      const auto more_rows = hn::IfThenZeroElse(is_large, down.more[k]);
      cell = hn::IfThenElse(is_large, large, cell);
      crossings.row |= std::uint64_t{bits_of(d, hn::Gt(more_rows, zero))} << i;
      crossings.further |= std::uint64_t{bits_of(d, hn::Gt(hn::Max(more_rows, more_columns), one))} << i;
      hn::StoreU(hn::Or(cell, hn::Or(hn::ShiftLeft<16>(more_rows), hn::ShiftLeft<24>(more_columns))), d,
                 &places[i].bits);
    }
  }
  crossings.further |= crossings.row & crossings.column;
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - count);
  valid &= all;
  if (HWY_UNLIKELY(valid != all)) {
    for_each_bit(all ^ valid, [&](unsigned i) { places[i].bits = grid.absent(); });
  }
  crossings = {crossings.row & valid, crossings.column & valid, crossings.further & valid};
  for (std::size_t i = 0; i < count; ++i) ++counts[places[i].cell()];
  for_each_bit(crossings.row, [&](unsigned i) { ++counts[places[i].cell() + grid.columns.count]; });
  for_each_bit(crossings.column, [&](unsigned i) { ++counts[places[i].cell() + 1]; });
  for_each_bit(crossings.further, [&](unsigned i) {
    for_each_further(places[i],
                     [&](unsigned r, unsigned c) { ++counts[places[i].cell() + r * grid.columns.count + c]; });
  });
  return crossings;
}

HWY_ATTR void CopyToCells(const Record* HWY_RESTRICT records, std::size_t count, const Place* HWY_RESTRICT places,
                          const Crossings& crossings, const Grid& grid, std::size_t* HWY_RESTRICT cursors,
                          Record* HWY_RESTRICT out) {
  const hn::CappedTag<std::uint32_t, 8> d;
  constexpr std::size_t lanes_of_record = hn::MaxLanes(decltype(d)());
  struct alignas(32) Bits {
    std::uint32_t words[8];
  };
  const auto copy = [&](unsigned i, const Bits& bits, unsigned cell) {
    const auto* from = reinterpret_cast<const std::uint32_t*>(records + i);
    auto* to = reinterpret_cast<std::uint32_t*>(out + cursors[cell]++);
    prefetch_to_write(out + cursors[cell] + 1);  // more open streams than a processor follows by itself
    for (std::size_t w = 0; w < 8; w += lanes_of_record)
      hn::StoreU(hn::Or(hn::LoadU(d, from + w), hn::Load(d, bits.words + w)), d, to + w);
  };
  const auto bits_of_axes = [](unsigned bits) { return Bits{{0, 0, 0, 0, 0, 0, 0, bits}}; };
  const Bits none = bits_of_axes(0), row = bits_of_axes(grid.rows.bit()), column = bits_of_axes(grid.columns.bit());
  const unsigned columns = grid.columns.count;
  for (unsigned i = 0; i < count; ++i) copy(i, none, places[i].cell());
  for_each_bit(crossings.row, [&](unsigned i) { copy(i, row, places[i].cell() + columns); });
  for_each_bit(crossings.column, [&](unsigned i) { copy(i, column, places[i].cell() + 1); });
  for_each_bit(crossings.further, [&](unsigned i) {
    for_each_further(places[i], [&](unsigned r, unsigned c) {
      copy(i, bits_of_axes((r == 0 ? 0 : grid.rows.bit()) | (c == 0 ? 0 : grid.columns.bit())),
           places[i].cell() + r * columns + c);
    });
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Locate);
HWY_EXPORT(CopyToCells);

Crossings locate(const Record* records, std::size_t count, std::uint64_t valid, const Grid& grid, Place* places,
                 std::uint32_t* counts) {
  return HWY_DYNAMIC_DISPATCH(Locate)(records, count, valid, grid, places, counts);
}

void copy_to_cells(const Record* records, std::size_t count, const Place* places, const Crossings& crossings,
                   const Grid& grid, std::size_t* cursors, Record* out) {
  HWY_DYNAMIC_DISPATCH(CopyToCells)(records, count, places, crossings, grid, cursors, out);
}

}  // namespace boxstream::detail
#endif
