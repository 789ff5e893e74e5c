// SPDX-License-Identifier: MIT
//
// Sets of boxes put in the order of a sweep, with what it compares first in columns.

#if defined(BOXSTREAM_SWEEP_ORDER_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_SWEEP_ORDER_INL_HPP_
#undef BOXSTREAM_SWEEP_ORDER_INL_HPP_
#else
#define BOXSTREAM_SWEEP_ORDER_INL_HPP_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/arena.hpp"
#include "base/thresholds.hpp"
#include "batch/leaf/buckets.hpp"
#include "batch/leaf/ranked_lows.hpp"
#include "batch/leaf/sweep.hpp"
#include "batch/leaf/sweep_exact-inl.hpp"
#include "batch/records/record.hpp"
#include "batch/records/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

/// One set of boxes in sweep order: by bucket of the low end, or sorted by it. Beyond `size`, a block of boxes that
/// overlap nothing.
struct Ordered {
  std::size_t size = 0;
  const Record* records = nullptr;
  // Columns of what a sweep compares first:
  const std::int32_t* lo = nullptr;  // on the sweep axis
  const std::int32_t* hi = nullptr;
  const std::uint32_t* packed = nullptr;  // on the other two, see pack

  const Buckets* buckets = nullptr;       // null: sorted
  const std::uint32_t* start = nullptr;   // per bucket: position of its first box; one more at the end
  const std::uint64_t* sorted = nullptr;  // ranked low ends
  const Aabb64* originals = nullptr;      // of doubles, by the ids of records
  const ExactRecord* exact = nullptr;     // theirs in sweep order, made when they are needed

  /// Where boxes with low ends of `key` and more start, or only those above; perhaps some before.
  std::size_t begin_of(std::int32_t key, bool above = false) const {
    return buckets != nullptr ? start[(*buckets)(key)] : count_below(sorted, size, key, above);
  }
  /// Where boxes with low ends above `key` start; perhaps some after.
  std::size_t end_of(std::int32_t key) const {
    return buckets != nullptr ? start[(*buckets)(key) + 1] : count_below(sorted, size, key, true);
  }
};

inline std::uint32_t bucket_count(std::size_t boxes) {
  return static_cast<std::uint32_t>(
      std::clamp<std::size_t>(boxes / thresholds.boxes_per_bucket, 1, std::size_t{1} << 20));
}

/// A set on its way into sweep order.
struct Unordered {
  Span<const Record> records;
  std::int32_t* lo = nullptr;  // on the sweep axis
  std::uint32_t* bucket = nullptr;
  std::uint32_t* start = nullptr;  // per bucket: position of its first box; one more at the end
};

inline HWY_ATTR Unordered extract(Span<const Record> records, int axis, std::size_t most_boxes, Arena& arena) {
  Unordered set;
  set.records = records;
  set.lo = arena.allocate<std::int32_t>(records.size());
  set.bucket = arena.allocate<std::uint32_t>(records.size());
  set.start = arena.allocate<std::uint32_t>(bucket_count(most_boxes) + 1);
  for (std::size_t i = 0; i < records.size(); ++i) set.lo[i] = records[i].lo[axis];
  return set;
}

/// Where low ends lie, on each axis, but for boxes that begin before the region there.
struct Extent {
  std::int32_t min[4] = {INT32_MAX, INT32_MAX, INT32_MAX, INT32_MAX};
  std::int32_t max[4] = {INT32_MIN, INT32_MIN, INT32_MIN, INT32_MIN};
};

inline HWY_ATTR void extend(Extent& extent, Span<const Record> records) {
#if HWY_TARGET == HWY_SCALAR
  for (const Record& r : records)
    for (int d = 0; d < 3; ++d) {
      if ((r.before >> d & 1) == 0) extent.min[d] = std::min(extent.min[d], r.lo[d]);
      extent.max[d] = std::max(extent.max[d], r.lo[d]);
    }
#else
  const hn::FixedTag<std::int32_t, 4> d;
  // By the bits of `before`: no limit from below, or an end that is no minimum.
  alignas(16) std::int32_t least[8][4];
  for (unsigned bits = 0; bits < 8; ++bits)
    for (unsigned axis = 0; axis < 4; ++axis) least[bits][axis] = (bits >> axis & 1) != 0 ? INT32_MAX : INT32_MIN;
  auto lowest = hn::LoadU(d, extent.min), highest = hn::LoadU(d, extent.max);
  for (const Record& r : records) {
    const auto lo = hn::LoadU(d, r.lo);
    lowest = hn::Min(lowest, hn::Max(lo, hn::Load(d, least[r.before & 7])));
    highest = hn::Max(highest, lo);
  }
  hn::StoreU(lowest, d, extent.min);
  hn::StoreU(highest, d, extent.max);
#endif
}

/// Counts boxes per bucket; returns the sum of squares, which is about twice the comparisons within buckets.
inline HWY_ATTR std::uint64_t count_buckets(Unordered& set, const Buckets& buckets) {
  const std::size_t n = set.records.size();
  const Buckets map = buckets;  // so that the loop keeps it in registers
  std::uint32_t* HWY_RESTRICT bucket = set.bucket;
  const std::int32_t* HWY_RESTRICT lo = set.lo;
  for (std::size_t i = 0; i < n; ++i) bucket[i] = map(lo[i]);
  std::fill_n(set.start, buckets.count() + 1, 0u);
  for (std::size_t i = 0; i < n; ++i) ++set.start[bucket[i]];
  std::uint32_t sum = 0;
  std::uint64_t squares = 0;
  for (std::uint32_t b = 0; b <= buckets.count(); ++b) {
    const std::uint32_t count = set.start[b];
    squares += std::uint64_t{count} * count;
    set.start[b] = sum;
    sum += count;
  }
  return squares;
}

// A block, and what makes the whole a multiple of four.
constexpr std::size_t padding = block + 3;

inline void pad(Record* end, std::size_t count) {
  std::fill_n(end, count, Record{{INT32_MAX, INT32_MAX, INT32_MAX}, 0, {INT32_MIN, INT32_MIN, INT32_MIN}, 0});
}

inline Ordered finish(Record* records, std::size_t size) {
  pad(records + size, padding);
  Ordered o;
  o.size = size;
  o.records = records;
  return o;
}

inline HWY_ATTR Ordered order_by_bucket(const Unordered& set, const Buckets& buckets, Arena& arena) {
  Record* out = arena.allocate<Record>(set.records.size() + padding);
  std::uint32_t* cursor = arena.allocate<std::uint32_t>(buckets.count());
  std::copy_n(set.start, buckets.count(), cursor);
  for (std::size_t i = 0; i < set.records.size(); ++i) out[cursor[set.bucket[i]]++] = set.records[i];
  Ordered o = finish(out, set.records.size());
  o.buckets = &buckets;
  o.start = set.start;
  return o;
}

/// For sets that even buckets do not part.
inline HWY_ATTR Ordered order_by_sort(const Unordered& set, Arena& arena) {
  const std::size_t n = set.records.size();
  auto* numbers = arena.allocate<std::uint64_t>(n);
  for (std::size_t i = 0; i < n; ++i) numbers[i] = ranked(set.lo[i], i);
  const std::uint64_t* const order = sort_ranked(numbers, arena.allocate<std::uint64_t>(n), n);
  Record* out = arena.allocate<Record>(n + padding);
  for (std::size_t i = 0; i < n; ++i) out[i] = set.records[position_of(order[i])];
  Ordered o = finish(out, n);
  o.sorted = order;
  return o;
}

/// What a sweep compares first, four bounds in one word: for the axes across the sweep, low ends and complements of
/// high ends, as monotone maps to bytes. Boxes that overlap there still do as bytes, so bytes that are apart decide;
/// others have to be looked at again. With x and y the words of two boxes, they may overlap if no byte of x is above
/// that of opposite(y).
inline HWY_ATTR void pack(Ordered& set, const Buckets& u_map, const Buckets& v_map, int w, bool has_doubts,
                          Arena& arena) {
  constexpr std::size_t chunk = 64;
  const int u = (w + 1) % 3, v = (w + 2) % 3;
  auto* HWY_RESTRICT packed = arena.allocate<std::uint32_t>(set.size + block);
  auto *HWY_RESTRICT lo = arena.allocate<std::int32_t>(set.size + block),
                     *HWY_RESTRICT hi = arena.allocate<std::int32_t>(set.size + block);
  const Buckets in_u = u_map, in_v = v_map;
  for (std::size_t begin = 0; begin < set.size + block; begin += chunk) {
    const std::size_t size = std::min(chunk, set.size + block - begin);
    std::int32_t lo_u[chunk], hi_u[chunk], lo_v[chunk], hi_v[chunk];
    for (std::size_t i = 0; i < size; ++i) {
      const Record& r = set.records[begin + i];
      if (has_doubts) ask_for_original(r, set.originals);
      lo_u[i] = r.lo[u];
      hi_u[i] = r.hi[u];
      lo_v[i] = r.lo[v];
      hi_v[i] = r.hi[v];
      lo[begin + i] = r.lo[w];
      hi[begin + i] = r.hi[w];
    }
    for (std::size_t i = 0; i < size; ++i)
      packed[begin + i] =
          in_u(lo_u[i]) | (255 - in_u(hi_u[i])) << 8 | in_v(lo_v[i]) << 16 | (255 - in_v(hi_v[i])) << 24;
  }
  set.lo = lo;
  set.hi = hi;
  set.packed = packed;
}

inline HWY_ATTR void pack_both(Ordered& a, Ordered* b, int w, const Extent& extent, const SweepContext& context) {
  Buckets maps[2];
  for (int i = 0; i < 2; ++i) {
    const int axis = (w + 1 + i) % 3;
    maps[i] = Buckets(context.kinds[axis], extent.min[axis], extent.max[axis], 256);
  }
  const bool has_doubts = context.has_doubts && context.originals.a != nullptr;
  pack(a, maps[0], maps[1], w, has_doubts, context.arena);
  if (b != nullptr) pack(*b, maps[0], maps[1], w, has_doubts, context.arena);
}

/// Buckets over the whole range of low ends; if a few far ones leave the rest too few buckets, over the range where
/// most are; and if that is no better, none.
template <class Count>
HWY_INLINE bool find_buckets(const SweepPlan& plan, const SweepContext& context, std::int32_t min_key,
                             std::int32_t max_key, std::size_t boxes, std::size_t most, Buckets& buckets,
                             const Count& count) {
  const KeyKind kind = context.kinds[plan.axis];
  buckets = Buckets(kind, min_key, max_key, bucket_count(boxes));
  if (count() <= most) return true;
  if (plan.typical_min <= min_key && plan.typical_max >= max_key) return false;
  buckets =
      Buckets(kind, std::max(min_key, plan.typical_min), std::min(max_key, plan.typical_max), bucket_count(boxes));
  return count() <= most;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
