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
#include "batch/records/quadruples-inl.hpp"
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

/// Where low ends lie, on each axis, but for boxes that begin before the region there.
struct Extent {
  std::int32_t min[3] = {INT32_MAX, INT32_MAX, INT32_MAX};
  std::int32_t max[3] = {INT32_MIN, INT32_MIN, INT32_MIN};
};

/// The same, of the boxes of each lane.
class LaneExtents {
 public:
  HWY_INLINE LaneExtents() {
    for (int axis = 0; axis < 3; ++axis) {
      lowest_[axis] = hn::Set(D(), INT32_MAX);
      highest_[axis] = hn::Set(D(), INT32_MIN);
    }
  }
  /// Of as many records as there are lanes, or up to the last; their low ends on one axis become a column.
  HWY_INLINE void add(const Record* records, std::size_t last, int axis, std::int32_t* column) {
    V lo[4];
    load_columns_of(D(), records, last, 0, lo);
    hn::StoreU(lo[axis], D(), column);
    const auto before = load_fourth_column_of(D(), records, last, 4);
    add(0, lo[0], hn::ShiftLeft<31>(before));
    add(1, lo[1], hn::ShiftLeft<30>(before));
    add(2, lo[2], hn::ShiftLeft<29>(before));
  }
  HWY_INLINE void add_to(Extent& extent) const {
    for (int axis = 0; axis < 3; ++axis) {
      extent.min[axis] = std::min(extent.min[axis], hn::GetLane(hn::MinOfLanes(D(), lowest_[axis])));
      extent.max[axis] = std::max(extent.max[axis], hn::GetLane(hn::MaxOfLanes(D(), highest_[axis])));
    }
  }

 private:
  HWY_INLINE void add(int axis, V lo, V negative_if_before) {
    const auto none = hn::Set(D(), INT32_MAX);
    lowest_[axis] = hn::Min(lowest_[axis], hn::IfNegativeThenElse(negative_if_before, none, lo));
    highest_[axis] = hn::Max(highest_[axis], lo);
  }

  V lowest_[3], highest_[3];
};

/// Also adds the extent of the records.
inline HWY_ATTR Unordered extract(Span<const Record> records, int axis, std::size_t most_boxes, Extent& extent,
                                  Arena& arena) {
  const std::size_t n = records.size();
  Unordered set;
  set.records = records;
  set.lo = arena.allocate<std::int32_t>(n + block);
  set.bucket = arena.allocate<std::uint32_t>(n);
  set.start = arena.allocate<std::uint32_t>(bucket_count(most_boxes) + 1);
  LaneExtents extents;
  const Record* const first = records.data();
  std::size_t at = 0;
  for (; at + lanes <= n; at += lanes) extents.add(first + at, SIZE_MAX, axis, set.lo + at);
  if (at < n) extents.add(first + at, n - 1 - at, axis, set.lo + at);
  extents.add_to(extent);
  return set;
}

/// Counts boxes per bucket; returns the sum of squares, which is about twice the comparisons within buckets.
inline HWY_ATTR std::uint64_t count_buckets(Unordered& set, const Buckets& buckets) {
  const std::size_t n = set.records.size();
  const Buckets map = buckets;  // so that the loop keeps it in registers
  std::uint32_t *HWY_RESTRICT bucket = set.bucket, *HWY_RESTRICT start = set.start;
  const std::int32_t* HWY_RESTRICT lo = set.lo;
  for (std::size_t i = 0; i < n; ++i) bucket[i] = map(lo[i]);
  const std::uint32_t last = map.count();
  std::fill_n(start, last + 1, 0u);
  for (std::size_t i = 0; i < n; ++i) ++start[bucket[i]];
  std::uint32_t sum = 0;
  std::uint64_t squares = 0;
  for (std::uint32_t b = 0; b <= last; ++b) {
    const std::uint32_t count = start[b];
    squares += std::uint64_t{count} * count;
    start[b] = sum;
    sum += count;
  }
  return squares;
}

constexpr std::size_t chunk = 2 * block;  // of boxes packed together
constexpr std::size_t padding = block, room_behind = padding + chunk;

/// In as few vectors as there are.
HWY_INLINE void copy_record(const Record& from, Record& to) {
  const hn::CappedTag<std::int32_t, 8> d;
  for (std::size_t w = 0; w < 8; w += hn::MaxLanes(decltype(d)()))
    hn::StoreU(hn::LoadU(d, reinterpret_cast<const std::int32_t*>(&from) + w), d,
               reinterpret_cast<std::int32_t*>(&to) + w);
}

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
  Record* HWY_RESTRICT out = arena.allocate<Record>(set.records.size() + room_behind);
  std::uint32_t* HWY_RESTRICT cursor = arena.allocate<std::uint32_t>(buckets.count());
  std::copy_n(set.start, buckets.count(), cursor);
  const std::size_t n = set.records.size();
  const auto* HWY_RESTRICT in = set.records.data();
  const auto* HWY_RESTRICT bucket = set.bucket;
  for (std::size_t i = 0; i < n; ++i) copy_record(in[i], out[cursor[bucket[i]]++]);
  Ordered o = finish(out, n);
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
  Record* out = arena.allocate<Record>(n + room_behind);
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
  const int u = (w + 1) % 3, v = (w + 2) % 3;
  const std::size_t room = set.size + block, columns = room + chunk;
  auto* HWY_RESTRICT packed = arena.allocate<std::uint32_t>(columns);
  auto *HWY_RESTRICT lo = arena.allocate<std::int32_t>(columns),
                     *HWY_RESTRICT hi = arena.allocate<std::int32_t>(columns);
  const Buckets in_u = u_map, in_v = v_map;
  for (std::size_t begin = 0; begin < room; begin += chunk) {
    if (has_doubts)
      for (std::size_t i = begin; i < std::min(begin + chunk, room); ++i)
        ask_for_original(set.records[i], set.originals);
    // Beyond, all may be anything.
    HWY_ALIGN std::int32_t lows[3][chunk], highs[3][chunk];
    for (std::size_t i = 0; i < chunk; i += lanes) {
      V low[4], high[4];
      load_columns_of(D(), set.records + begin + i, SIZE_MAX, 0, low);
      load_columns_of(D(), set.records + begin + i, SIZE_MAX, 4, high);
      for (int axis = 0; axis < 3; ++axis) {
        hn::Store(low[axis], D(), lows[axis] + i);
        hn::Store(high[axis], D(), highs[axis] + i);
      }
    }
    const std::int32_t *lo_u = lows[u], *hi_u = highs[u], *lo_v = lows[v], *hi_v = highs[v];
    std::uint32_t of_u[chunk];
    for (std::size_t i = 0; i < chunk; ++i) of_u[i] = (in_u(lo_u[i]) | in_u(hi_u[i]) << 8) ^ 0xff00ff00u;
    for (std::size_t i = 0; i < chunk; ++i) packed[begin + i] = of_u[i] ^ (in_v(lo_v[i]) << 16 | in_v(hi_v[i]) << 24);
    std::copy_n(lows[w], chunk, lo + begin);
    std::copy_n(highs[w], chunk, hi + begin);
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
