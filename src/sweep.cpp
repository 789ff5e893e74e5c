// SPDX-License-Identifier: MIT
//
// The leaf of the tree: a sweep over a few hundred to a few thousand boxes that lie in cache. Compiled once per SIMD
// target; the best one for the machine is picked at run time.

#include "sweep.hpp"

#include <boxstream/detector.hpp>

#include "buckets.hpp"
#include "ranked_lows.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Boxes of a block, which are compared with one other box at a time. The same on every target, for it shows in the
// order of pairs; a narrower vector makes a block of several.
constexpr std::size_t block = 16;
using D = hn::CappedTag<std::int32_t, block>;
using DU = hn::CappedTag<std::uint32_t, block>;
constexpr std::size_t lanes = hn::MaxLanes(D());
constexpr std::size_t vectors = block / lanes;
using V = hn::VFromD<D>;
using VU = hn::VFromD<DU>;
using M = decltype(hn::Gt(V(), V()));
using MU = decltype(hn::Eq(VU(), VU()));

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

  /// Where boxes with low ends of `key` and more start; perhaps some before.
  std::size_t begin_of(std::int32_t key) const {
    return buckets != nullptr ? start[(*buckets)(key)] : count_below(sorted, size, key, false);
  }
  /// Where boxes with low ends above `key` start; perhaps some after.
  std::size_t end_of(std::int32_t key) const {
    return buckets != nullptr ? start[(*buckets)(key) + 1] : count_below(sorted, size, key, true);
  }
};

// Boxes per bucket to aim for: a window wastes about one bucket.
constexpr std::size_t boxes_per_bucket = 4;
// Comparisons per box within its own bucket beyond which sorting is cheaper.
constexpr std::size_t most_own_bucket_tests = 32;

std::uint32_t bucket_count(std::size_t boxes) {
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(boxes / boxes_per_bucket, 1, std::size_t{1} << 20));
}

/// A set on its way into sweep order.
struct Unordered {
  Span<const Record> records;
  std::int32_t* lo = nullptr;  // on the sweep axis
  std::uint32_t* bucket = nullptr;
  std::uint32_t* start = nullptr;  // per bucket: position of its first box; one more at the end
};

HWY_ATTR Unordered extract(Span<const Record> records, int axis, std::size_t most_boxes, Arena& arena) {
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

HWY_ATTR void extend(Extent& extent, Span<const Record> records) {
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
HWY_ATTR std::uint64_t count_buckets(Unordered& set, const Buckets& buckets) {
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

void pad(Record* end, std::size_t count) {
  std::fill_n(end, count, Record{{INT32_MAX, INT32_MAX, INT32_MAX}, 0, {INT32_MIN, INT32_MIN, INT32_MIN}, 0});
}

Ordered finish(Record* records, std::size_t size) {
  pad(records + size, padding);
  Ordered o;
  o.size = size;
  o.records = records;
  return o;
}

HWY_ATTR Ordered order_by_bucket(const Unordered& set, const Buckets& buckets, Arena& arena) {
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
HWY_ATTR Ordered order_by_sort(const Unordered& set, Arena& arena) {
  const std::size_t n = set.records.size();
  auto* order = arena.allocate<std::uint64_t>(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = ranked(set.lo[i], i);
  std::sort(order, order + n);
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
HWY_ATTR void pack(Ordered& set, const Buckets& u_map, const Buckets& v_map, int w, Arena& arena) {
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

/// High ends and complements of low ends.
HWY_INLINE VU opposite(VU packed) {
  const DU d;
  const auto swapped = hn::Or(hn::And(hn::ShiftRight<8>(packed), hn::Set(d, 0x00ff00ffu)),
                              hn::And(hn::ShiftLeft<8>(packed), hn::Set(d, 0xff00ff00u)));
  return hn::Not(swapped);
}

/// Lanes in which no byte of `x` is above that of `opposite_y`.
HWY_INLINE MU may_overlap(VU x, VU opposite_y) {
  const DU d;
#if HWY_TARGET == HWY_SCALAR
  // Bytes apart, each below a guard bit that a difference below zero borrows.
  const auto spread = [](std::uint64_t bytes) {
    bytes = (bytes | bytes << 16) & 0x0000ffff0000ffffu;
    return (bytes | bytes << 8) & 0x00ff00ff00ff00ffu;
  };
  constexpr std::uint64_t guards = 0x0100010001000100u;
  const std::uint64_t left = (spread(hn::GetLane(opposite_y)) | guards) - spread(hn::GetLane(x));
  return hn::Eq(hn::Set(d, (left & guards) == guards ? 1u : 0u), hn::Set(d, 1u));
#else
  const hn::Repartition<std::uint8_t, DU> d8;
  return hn::Eq(hn::BitCast(d, hn::SaturatedSub(hn::BitCast(d8, x), hn::BitCast(d8, opposite_y))), hn::Zero(d));
#endif
}

#if HWY_TARGET != HWY_SCALAR
/// Four quadruples side by side to four columns.
HWY_INLINE void transpose(const Record* from, std::size_t offset, std::int32_t* c0, std::int32_t* c1, std::int32_t* c2,
                          std::int32_t* c3) {
  const hn::FixedTag<std::int32_t, 4> d;
  const hn::FixedTag<std::int64_t, 2> d64;
  const auto row = [&](int i) { return hn::Load(d, reinterpret_cast<const std::int32_t*>(from + i) + offset); };
  const auto r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
  const auto wide = [&](auto v) { return hn::BitCast(d64, v); };
  const auto low01 = wide(hn::InterleaveLower(d, r0, r1)), low23 = wide(hn::InterleaveLower(d, r2, r3));
  const auto high01 = wide(hn::InterleaveUpper(d, r0, r1)), high23 = wide(hn::InterleaveUpper(d, r2, r3));
  hn::Store(hn::BitCast(d, hn::InterleaveLower(d64, low01, low23)), d, c0);
  hn::Store(hn::BitCast(d, hn::InterleaveUpper(d64, low01, low23)), d, c1);
  hn::Store(hn::BitCast(d, hn::InterleaveLower(d64, high01, high23)), d, c2);
  hn::Store(hn::BitCast(d, hn::InterleaveUpper(d64, high01, high23)), d, c3);
}
#endif

/// Records as a structure of arrays.
struct Columns {
  const std::int32_t* lo[3] = {};
  const std::int32_t* hi[3] = {};
  const std::uint32_t* id = nullptr;
  const std::uint32_t* before = nullptr;
};

/// Of `room` records, a multiple of four.
HWY_ATTR Columns make_columns(const Record* records, std::size_t room, Arena& arena) {
  std::int32_t* column[8];
  const std::size_t stride = (room + block - 1) / block * block;  // so that each is aligned as the first
  column[0] = arena.allocate<std::int32_t>(8 * stride);
  for (std::size_t c = 1; c < 8; ++c) column[c] = column[c - 1] + stride;
#if HWY_TARGET == HWY_SCALAR
  for (std::size_t i = 0; i < room; ++i)
    for (int c = 0; c < 8; ++c) std::memcpy(column[c] + i, reinterpret_cast<const char*>(records + i) + 4 * c, 4);
#else
  for (std::size_t i = 0; i < room; i += 4) {
    transpose(records + i, 0, column[0] + i, column[1] + i, column[2] + i, column[3] + i);
    transpose(records + i, 4, column[4] + i, column[5] + i, column[6] + i, column[7] + i);
  }
#endif
  Columns columns;
  for (int d = 0; d < 3; ++d) {
    columns.lo[d] = column[d];
    columns.hi[d] = column[4 + d];
  }
  columns.id = reinterpret_cast<const std::uint32_t*>(column[3]);
  columns.before = reinterpret_cast<const std::uint32_t*>(column[7]);
  return columns;
}

/// Stores the pairs of the first `count` lanes; room for all of them is needed.
HWY_INLINE void store(VU a, VU b, std::size_t count, Pair* out) {
#if HWY_TARGET == HWY_SCALAR
  (void)count;
  *out = {hn::GetLane(a), hn::GetLane(b)};
#else
  // By way of 64-bit lanes, which takes fewer shuffles than to interleave.
  const hn::Half<DU> dh;
  const hn::RepartitionToWide<DU> d64;
  const auto join = [](auto first, auto second) { return hn::Or(first, hn::ShiftLeft<32>(second)); };
  auto* words = reinterpret_cast<std::uint64_t*>(out);
  hn::StoreU(join(hn::PromoteTo(d64, hn::LowerHalf(dh, a)), hn::PromoteTo(d64, hn::LowerHalf(dh, b))), d64, words);
  if (HWY_LIKELY(count <= lanes / 2)) return;
  hn::StoreU(join(hn::PromoteTo(d64, hn::UpperHalf(dh, a)), hn::PromoteTo(d64, hn::UpperHalf(dh, b))), d64,
             words + lanes / 2);
#endif
}

enum class Emit { sorted, set_first, other_first };
enum class Ties { kept, dropped };  // pairs whose low ends on the sweep axis are equal

/// Stores those of the lanes in `bits`, of the boxes at `at`, that are pairs with `one`; returns where they end.
template <Emit emit, bool one_is_of_set>
HWY_INLINE Pair* put(const Record& one, const Columns& many, std::size_t at, std::uint32_t bits, Pair* out) {
  const D d;
  const DU du;
  const auto apart = [&](int axis) {
    return hn::Or(hn::Gt(hn::LoadU(d, many.lo[axis] + at), hn::Set(d, one.hi[axis])),
                  hn::Gt(hn::Set(d, one.lo[axis]), hn::LoadU(d, many.hi[axis] + at)));
  };
  const auto owned = hn::Eq(hn::And(hn::LoadU(du, many.before + at), hn::Set(du, one.before)), hn::Zero(du));
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  const auto hit = hn::And(hn::LoadMaskBits(du, bytes),
                           hn::AndNot(hn::RebindMask(du, hn::Or(hn::Or(apart(0), apart(1)), apart(2))), owned));
  const std::size_t count = hn::CountTrue(du, hit);
  const auto id = hn::Set(du, one.id), found = hn::Compress(hn::LoadU(du, many.id + at), hit);
  if constexpr (emit == Emit::sorted)
    store(hn::Min(id, found), hn::Max(id, found), count, out);
  else if constexpr ((emit == Emit::set_first) == one_is_of_set)
    store(id, found, count, out);
  else
    store(found, id, count, out);
  return out + count;
}

/// Lanes of a block that may overlap a box: the block is of the set and the box another, or the box is of the set and
/// the block another.
struct Hit {
  std::uint32_t set;    // position of the box, or of the block's first
  std::uint32_t other;  // the same
  std::uint32_t mask;   // bit i: lane i
  std::uint32_t unused;
};

/// Which of the boxes of a set come before one of another set that they may overlap: what a sweep is made of.
/// Between two sets each pair is found by the box that begins first; within a set, by the one that comes first.
///
/// First the finding: hits are only noted, at a pace that does not depend on how many there are. Then, for many hits at
/// a time, the close look. So neither has branches that depend on where boxes happen to overlap.
template <Emit emit, bool is_self, Ties ties>
class Sweep {
 public:
  Sweep(const Ordered& set, const Ordered& other, int axis, SweepContext& context)
      : set_(set),
        other_(other),
        axis_(axis),
        pairs_(context.pairs),
        hits_(context.arena.allocate<Hit>(most_hits + 2 * window)),
        found_(context.arena.allocate<Found>(hits_at_once * eager + eager)),
        arena_(context.arena) {}

  /// False when the buffer's owner wants to stop.
  HWY_ATTR bool run(std::uint64_t& tests) {
    for (std::size_t at = 0; at < set_.size; at += block)
      if (!sweep_block(at, tests)) return false;
    return look_closely<false>();
  }

 private:
  static constexpr std::size_t most_hits = 512;
  static constexpr std::size_t window = 256;  // positions looked at before the hits are counted again
  static constexpr std::size_t hits_at_once = 64;
  static constexpr std::size_t eager = 2;

  struct Found {
    std::uint32_t set, other;
  };

  HWY_INLINE bool sweep_block(std::size_t at, std::uint64_t& tests) {
    const D d;
    auto highest = hn::LoadU(d, set_.hi + at), lowest = hn::LoadU(d, set_.lo + at);
    for (std::size_t k = 1; k < vectors; ++k) {
      highest = hn::Max(highest, hn::LoadU(d, set_.hi + at + k * lanes));
      lowest = hn::Min(lowest, hn::LoadU(d, set_.lo + at + k * lanes));
    }
    const std::size_t first = is_self ? at + 1 : other_.begin_of(hn::GetLane(hn::MinOfLanes(d, lowest)));
    const std::size_t last = other_.end_of(hn::GetLane(hn::MaxOfLanes(d, highest)));
    if (first >= last) return true;
    const std::size_t after_block = is_self ? std::min(last, at + block) : first;
    if (is_self) find_in_window<true>(at, first, after_block);
    tests += (after_block - first) * block;
    if (last - after_block > longest_window) return sweep_far(at, after_block, last, tests);
    tests += (last - after_block) * block;
    return sweep_window(at, after_block, last);
  }

  HWY_INLINE bool sweep_window(std::size_t at, std::size_t first, std::size_t last) {
    for (; first < last; first += window) {
      find_in_window<false>(at, first, std::min(first + window, last));
      if (hit_count_ >= most_hits && !look_closely<false>()) return false;
    }
    return hit_count_ < most_hits || look_closely<false>();
  }

  // What a block costs for a position of its window; what a box alone costs to begin, and for a position.
  // In 1/24 of a nanosecond, about.
  static constexpr std::size_t block_position = 24;
  static constexpr std::size_t run_begin = 120;
  static constexpr std::size_t run_position = 1;
  static constexpr std::size_t longest_window = 12 * block;

  /// A block of which some boxes reach far: perhaps only they should be taken on to the end, each alone.
  bool sweep_far(std::size_t at, std::size_t first, std::size_t last, std::uint64_t& tests) {
    std::size_t sum = 0;
    std::uint32_t run_first[block], run_last[block];
    const std::size_t in_block = std::min(block, set_.size - at);
    for (std::size_t i = 0; i < in_block; ++i) {
      run_last[i] = static_cast<std::uint32_t>(other_.end_of(set_.hi[at + i]));
      run_first[i] = static_cast<std::uint32_t>(is_self ? first : std::max(other_.begin_of(set_.lo[at + i]), first));
      sum += run_last[i] > run_first[i] ? run_last[i] - run_first[i] : 0;
    }
    const auto cost = [&](std::size_t end) {
      std::size_t sum_runs = 0, runs = 0;
      for (std::size_t i = 0; i < in_block; ++i) {
        const std::size_t begin = std::max<std::size_t>(end, run_first[i]);
        if (run_last[i] > begin) {
          ++runs;
          sum_runs += run_last[i] - begin;
        }
      }
      return (end - first) * block_position + runs * run_begin + sum_runs * run_position;
    };
    std::size_t window_end = last, best = cost(last);
    for (const std::size_t end : {std::min(last, first + sum / in_block), first}) {
      const std::size_t c = cost(end);
      if (c < best) {
        best = c;
        window_end = end;
      }
    }
    tests += (window_end - first) * block;
    if (!sweep_window(at, first, window_end)) return false;
    if (window_end == last) return true;
    if (!is_self && !look_closely<false>()) return false;
    for (std::size_t i = 0; i < in_block; ++i) {
      std::size_t begin = std::max<std::size_t>(window_end, run_first[i]);
      if (begin >= run_last[i]) continue;
      tests += run_last[i] - begin;
      for (; begin < run_last[i]; begin += window * block) {
        find_in_run(at + i, begin, std::min<std::size_t>(begin + window * block, run_last[i]));
        if (hit_count_ >= most_hits && !look_closely<!is_self>()) return false;
      }
    }
    return is_self || look_closely<true>();
  }

  /// Notes which lanes of the block at `at` may overlap boxes [first, last) of the other set. In the triangle of a
  /// block with itself, a box meets the lanes before its own only.
  template <bool triangle>
  HWY_INLINE void find_in_window(std::size_t at, std::size_t first, std::size_t last) {
    const D d;
    const DU du;
    V lo[vectors], hi[vectors];
    VU packed[vectors];
    for (std::size_t k = 0; k < vectors; ++k) {
      lo[k] = hn::LoadU(d, set_.lo + at + k * lanes);
      hi[k] = hn::LoadU(d, set_.hi + at + k * lanes);
      packed[k] = opposite(hn::LoadU(du, set_.packed + at + k * lanes));
    }
    const std::uint32_t* const other_packed = other_.packed;
    const std::int32_t* const other_lo = other_.lo;
    Hit* hit = hits_ + hit_count_;
    for (std::size_t j = first; j < last; ++j) {
      const auto o_packed = hn::Set(du, other_packed[j]);
      const auto o_lo = hn::Set(d, other_lo[j]);
      std::uint32_t mask = 0;
      for (std::size_t k = 0; k < vectors; ++k)
        mask |= bits_of(hn::AndNot(hn::RebindMask(du, begins_outside(o_lo, lo[k], hi[k])),
                                   may_overlap(o_packed, packed[k])))
                << (k * lanes);
      if constexpr (triangle) mask &= (std::uint32_t{1} << (j - at)) - 1;
      *hit = {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(j), mask, 0};
      hit += mask != 0 ? 1 : 0;
    }
    hit_count_ = static_cast<std::size_t>(hit - hits_);
  }

  /// Notes which blocks of boxes [first, last) of the other set, and some beyond, box `at` may overlap.
  HWY_INLINE void find_in_run(std::size_t at, std::size_t first, std::size_t last) {
    const D d;
    const DU du;
    const auto packed = opposite(hn::Set(du, set_.packed[at]));
    const auto lo = hn::Set(d, set_.lo[at]), hi = hn::Set(d, set_.hi[at]);
    Hit* hit = hits_ + hit_count_;
    for (std::size_t j = first; j < last; j += block) {
      std::uint32_t mask = 0;
      for (std::size_t k = 0; k < vectors; ++k) {
        const std::size_t i = j + k * lanes;
        mask |= bits_of(hn::AndNot(hn::RebindMask(du, begins_outside(hn::LoadU(d, other_.lo + i), lo, hi)),
                                   may_overlap(hn::LoadU(du, other_.packed + i), packed)))
                << (k * lanes);
      }
      // Within a set it does not matter which is which, and then the lanes are the set's as in a window.
      if constexpr (is_self)
        *hit = {static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(at), mask, 0};
      else
        *hit = {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(j), mask, 0};
      hit += mask != 0 ? 1 : 0;
    }
    hit_count_ = static_cast<std::size_t>(hit - hits_);
  }

  /// Within a set, a later box may begin before if they share a bucket, and still overlap.
  static HWY_INLINE M begins_outside(V other_lo, V lo, V hi) {
    const auto beyond = hn::Gt(other_lo, hi);
    if constexpr (is_self) return beyond;
    if constexpr (ties == Ties::kept) return hn::Or(beyond, hn::Gt(lo, other_lo));
    return hn::Or(beyond, hn::Not(hn::Gt(other_lo, lo)));
  }

  /// Emits those of the hits that are pairs.
  template <bool is_run>
  HWY_INLINE bool look_closely() {
    for (std::size_t begin = 0; begin < hit_count_; begin += hits_at_once) {
      part_by_density<is_run>(hits_ + begin, std::min(hits_at_once, hit_count_ - begin));
      if (!emit_sparse() || !emit_dense<is_run>()) return false;
    }
    hit_count_ = 0;
    return true;
  }

  /// Hits with many lanes are left for emit_dense, others for emit_sparse, lane by lane. So many lanes of each are
  /// written whether it has them or not, for how many it has is as good as random.
  template <bool is_run>
  HWY_INLINE void part_by_density(Hit* hits, std::size_t count) {
    Found* found = found_;
    std::size_t dense = 0;
    for (std::size_t h = 0; h < count; ++h) {
      const Hit hit = hits[h];
      std::uint32_t mask = hit.mask;
      const auto in_mask = static_cast<std::size_t>(hwy::PopCount(std::uint64_t{mask}));
      for (std::size_t i = 0; i < eager; ++i) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(mask | 0x10000u));
        mask &= mask - 1;
        found[i] = is_run ? Found{hit.set, hit.other + lane} : Found{hit.set + lane, hit.other};
      }
      found += in_mask <= eager ? in_mask : 0;
      hits[dense] = hit;
      dense += in_mask <= eager ? 0 : 1;
    }
    found_count_ = static_cast<std::size_t>(found - found_);
    dense_ = {hits, dense};
  }

  template <bool is_run>
  HWY_INLINE bool emit_dense() {
    if (dense_.empty()) return true;
    const Columns& many = is_run ? columns(other_, other_columns_) : columns(set_, set_columns_);
    const Record* const ones = is_run ? set_.records : other_.records;
    for (const Hit& hit : dense_) {
      const Record& one = ones[is_run ? hit.set : hit.other];
      const std::size_t at = is_run ? hit.other : hit.set;
      Pair* out = pairs_.end();
      for (std::size_t k = 0; k < vectors; ++k)
        out = put<emit, is_run>(one, many, at + k * lanes, hit.mask >> (k * lanes), out);
      pairs_.set_end(out);
      if (HWY_UNLIKELY(out >= pairs_.limit()) && !pairs_.flush()) return false;
    }
    return true;
  }

  const Columns& columns(const Ordered& set, Columns& made) {
    if (made.id == nullptr) made = make_columns(set.records, (set.size + block + 3) / 4 * 4, arena_);
    return made;
  }

  HWY_INLINE bool emit_sparse() {
    const std::size_t count = found_count_;
    const Found* const found = found_;
    const Record *const set_records = set_.records, *const other_records = other_.records;
    for (std::size_t begin = 0; begin < count; begin += PairBuffer::slack) {
      const std::size_t end = std::min(count, begin + PairBuffer::slack);
      Pair* out = pairs_.end();
      for (std::size_t i = begin; i < end; ++i) {
        const Record &set = set_records[found[i].set], &other = other_records[found[i].other];
        if constexpr (emit == Emit::sorted)
          *out = sorted(set.id, other.id);
        else if constexpr (emit == Emit::set_first)
          *out = {set.id, other.id};
        else
          *out = {other.id, set.id};
        out += is_pair(set, other) ? 1 : 0;
      }
      pairs_.set_end(out);
      if (HWY_UNLIKELY(out >= pairs_.limit()) && !pairs_.flush()) return false;
    }
    return true;
  }

  /// The smaller first; without the branch that a compiler may make of min and max, for it is as good as random.
  static HWY_INLINE Pair sorted(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t swap = (a ^ b) & (0u - static_cast<std::uint32_t>(b < a));
    return {a ^ swap, b ^ swap};
  }

  /// Whether two boxes overlap on all axes and this region owns the pair.
  static HWY_INLINE bool is_pair(const Record& x, const Record& y) {
#if HWY_TARGET == HWY_SCALAR
    const bool apart = x.lo[0] > y.hi[0] || y.lo[0] > x.hi[0] || x.lo[1] > y.hi[1] || y.lo[1] > x.hi[1] ||
                       x.lo[2] > y.hi[2] || y.lo[2] > x.hi[2];
    return !apart && (x.before & y.before) == 0;
#else
    const hn::FixedTag<std::int32_t, 4> d;
    const auto apart =
        hn::Or(hn::Gt(hn::Load(d, x.lo), hn::Load(d, y.hi)), hn::Gt(hn::Load(d, y.lo), hn::Load(d, x.hi)));
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, apart, bits);
    return ((bits[0] & 7u) | (x.before & y.before)) == 0;
#endif
  }

  static HWY_INLINE std::uint32_t bits_of(MU mask) {
    if constexpr (lanes > 8) {
      std::uint16_t bits;
      hn::StoreMaskBits(DU(), mask, reinterpret_cast<std::uint8_t*>(&bits));
      return bits;
    } else {
      std::uint8_t bits[8];
      hn::StoreMaskBits(DU(), mask, bits);
      return bits[0];
    }
  }

  const Ordered& set_;
  const Ordered& other_;
  int axis_;
  PairBuffer& pairs_;
  Hit* hits_;
  Found* found_;
  Arena& arena_;
  std::size_t hit_count_ = 0;
  std::size_t found_count_ = 0;
  Span<const Hit> dense_;
  Columns set_columns_, other_columns_;  // made when they are needed
};

HWY_ATTR void pack_both(Ordered& a, Ordered* b, int w, const Extent& extent, const SweepContext& context) {
  Buckets maps[2];
  for (int i = 0; i < 2; ++i) {
    const int axis = (w + 1 + i) % 3;
    maps[i] = Buckets(context.kinds[axis], extent.min[axis], extent.max[axis], 256);
  }
  pack(a, maps[0], maps[1], w, context.arena);
  if (b != nullptr) pack(*b, maps[0], maps[1], w, context.arena);
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

/// Compares all with all, a block with a box at a time: for sets so small that putting them in order takes longer.
template <Emit emit, bool is_self>
HWY_ATTR bool compare_all(Span<const Record> set, Span<const Record> other, SweepContext& context) {
  Arena::Frame frame(context.arena);
  const std::size_t room = (set.size() + block - 1) / block * block;
  Record* const padded = context.arena.allocate<Record>(room);
  std::copy_n(set.data(), set.size(), padded);
  pad(padded + set.size(), room - set.size());
  const Columns columns = make_columns(padded, room, context.arena);
  constexpr std::uint32_t all = (std::uint32_t{1} << block) - 1;
  PairBuffer& pairs = context.pairs;
  for (std::size_t at = 0; at < set.size(); at += block)
    for (std::size_t j = is_self ? at + 1 : 0; j < other.size(); ++j) {
      const std::uint32_t lanes_before = is_self && j < at + block ? (std::uint32_t{1} << (j - at)) - 1 : all;
      Pair* out = pairs.end();
      for (std::size_t k = 0; k < vectors; ++k)
        out = put<emit, false>(other[j], columns, at + k * lanes, lanes_before >> (k * lanes), out);
      pairs.set_end(out);
      if (HWY_UNLIKELY(out >= pairs.limit()) && !pairs.flush()) return false;
    }
  context.tests += is_self ? set.size() * (set.size() - 1) / 2 : set.size() * other.size();
  return true;
}

// Up to so many boxes, the comparisons of all with all take less time than an order that saves most of them. Between
// two sets, up to as many comparisons.
constexpr std::size_t few = 32;

HWY_ATTR bool SweepSelf(Span<const Record> records, const SweepPlan& plan, SweepContext& context) {
  if (records.size() <= few) return compare_all<Emit::sorted, true>(records, records, context);
  Arena& arena = context.arena;
  Arena::Frame frame(arena);
  Unordered set = extract(records, plan.axis, records.size(), arena);
  Extent extent;
  extend(extent, records);
  Buckets buckets;
  const bool in_buckets =
      find_buckets(plan, context, extent.min[plan.axis], extent.max[plan.axis], records.size(),
                   records.size() * most_own_bucket_tests, buckets, [&] { return count_buckets(set, buckets) / 2; });
  Ordered ordered = in_buckets ? order_by_bucket(set, buckets, arena) : order_by_sort(set, arena);
  pack_both(ordered, nullptr, plan.axis, extent, context);
  return Sweep<Emit::sorted, true, Ties::kept>(ordered, ordered, plan.axis, context).run(context.tests);
}

HWY_ATTR bool SweepCross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan, SweepContext& context) {
  if (a.size() * b.size() <= few * few / 2)
    return context.order == PairOrder::smaller_first ? compare_all<Emit::sorted, false>(a, b, context)
                                                     : compare_all<Emit::set_first, false>(a, b, context);
  Arena& arena = context.arena;
  Arena::Frame frame(arena);
  const std::size_t larger = std::max(a.size(), b.size());
  Unordered set_a = extract(a, plan.axis, larger, arena), set_b = extract(b, plan.axis, larger, arena);
  Extent extent;
  extend(extent, a);
  extend(extent, b);
  Buckets buckets;
  const bool in_buckets = find_buckets(plan, context, extent.min[plan.axis], extent.max[plan.axis], larger,
                                       (a.size() + b.size()) * most_own_bucket_tests, buckets, [&] {
                                         count_buckets(set_a, buckets);
                                         count_buckets(set_b, buckets);
                                         std::uint64_t same_bucket = 0;
                                         for (std::uint32_t i = 0; i < buckets.count(); ++i)
                                           same_bucket += std::uint64_t{set_a.start[i + 1] - set_a.start[i]} *
                                                          (set_b.start[i + 1] - set_b.start[i]);
                                         return same_bucket;
                                       });
  Ordered ordered_a = in_buckets ? order_by_bucket(set_a, buckets, arena) : order_by_sort(set_a, arena);
  Ordered ordered_b = in_buckets ? order_by_bucket(set_b, buckets, arena) : order_by_sort(set_b, arena);
  pack_both(ordered_a, &ordered_b, plan.axis, extent, context);
  const int w = plan.axis;
  std::uint64_t& tests = context.tests;
  if (context.order == PairOrder::smaller_first)
    return Sweep<Emit::sorted, false, Ties::kept>(ordered_a, ordered_b, w, context).run(tests) &&
           Sweep<Emit::sorted, false, Ties::dropped>(ordered_b, ordered_a, w, context).run(tests);
  return Sweep<Emit::set_first, false, Ties::kept>(ordered_a, ordered_b, w, context).run(tests) &&
         Sweep<Emit::other_first, false, Ties::dropped>(ordered_b, ordered_a, w, context).run(tests);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(SweepSelf);
HWY_EXPORT(SweepCross);

bool sweep_self(Span<const Record> records, const SweepPlan& plan, SweepContext& context) {
  return HWY_DYNAMIC_DISPATCH(SweepSelf)(records, plan, context);
}

bool sweep_cross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan, SweepContext& context) {
  return HWY_DYNAMIC_DISPATCH(SweepCross)(a, b, plan, context);
}

}  // namespace boxstream::detail

namespace boxstream {
const char* simd_target() {
  const auto compiled = hwy::SupportedTargets() & static_cast<decltype(hwy::SupportedTargets())>(HWY_TARGETS);
  return hwy::TargetName(compiled & -compiled);  // the lowest bit is the best
}
}  // namespace boxstream
#endif
