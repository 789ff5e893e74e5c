// SPDX-License-Identifier: MIT
//
// The leaf of the tree: a sweep over a few hundred boxes that lie in cache. Compiled once per SIMD target; the best one
// for the machine is picked at run time. The only file with vector code.

#include "sweep.hpp"

#include <boxstream/detector.hpp>

#include "ranked_lows.hpp"

#include <algorithm>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sweep.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t padding = PairBuffer::slack;

/// One set of boxes in sweep order, as a structure of arrays. Beyond `size`, `padding` boxes that overlap nothing, so
/// that vector loads need no tail.
struct Ordered {
  std::size_t size = 0;
  const std::int32_t* lo[3] = {};
  const std::int32_t* hi[3] = {};
  const std::uint32_t* id = nullptr;
  const std::uint32_t* before = nullptr;
  const std::uint32_t* first_run =
      nullptr;                             // per box: where boxes that may begin within it on the sweep axis start ...
  const std::uint32_t* end_run = nullptr;  // ... and end, as positions in the set it is swept over
};

/// Monotone map from keys on the sweep axis to buckets: about evenly spaced in the caller's coordinates, clamped at the
/// ends. Any monotone map gives the right pairs; an even one gives short runs. All in integers, so that the order of
/// pairs is the same in any floating-point environment.
class Buckets {
 public:
  Buckets(KeyKind kind, std::int32_t min_key, std::int32_t max_key, std::uint32_t wanted) {
    switch (kind) {
      case KeyKind::float32:
        fraction_bits_ = 23;
        break;
      case KeyKind::float64:
        fraction_bits_ = 20;
        break;
      case KeyKind::linear:
        fraction_bits_ = 0;
        break;
    }
    if (wanted <= 1 || min_key >= max_key) return;
    min_key_ = min_key;
    max_key_ = max_key;
    top_exponent_ = std::max(exponent(min_key), exponent(max_key));
    first_ = fixed_point(min_key);
    const std::uint32_t range = static_cast<std::uint32_t>(fixed_point(max_key)) - static_cast<std::uint32_t>(first_);
    // Positions of 16 bits and a factor of at most 2^32 / 2^16 buckets: their product is the bucket's number times
    // 2^16.
    while ((range >> shift_) >= 1u << 16) ++shift_;
    count_ = std::min(wanted, most_buckets);
    factor_ = ((count_ << 16) - 1) / ((range >> shift_) + 1);
  }

  std::uint32_t count() const { return count_; }

  HWY_ATTR void locate(const std::int32_t* HWY_RESTRICT keys, std::size_t size,
                       std::uint32_t* HWY_RESTRICT buckets) const {
    if (count_ == 1) {
      std::fill_n(buckets, size, 0u);
      return;
    }
    const Buckets map = *this;  // so that the loop keeps it in registers
    for (std::size_t i = 0; i < size; ++i) buckets[i] = map.bucket(keys[i]);
  }

 private:
  static constexpr std::uint32_t most_buckets = 1u << 15;

  // An order key is sign and magnitude; the magnitude of a floating-point number is exponent and fraction.
  std::int32_t exponent(std::int32_t key) const {
    return fraction_bits_ == 0 ? 0 : std::max((key ^ (key >> 31)) >> fraction_bits_, 1);
  }
  std::int32_t fixed_point(std::int32_t key) const {
    if (fraction_bits_ == 0) return key >> 1;
    const std::int32_t sign = key >> 31, magnitude = key ^ sign, hidden_bit = 1 << fraction_bits_;
    const std::int32_t fraction = (magnitude & (hidden_bit - 1)) | (magnitude >= hidden_bit ? hidden_bit : 0);
    const std::int32_t below_top = std::min(top_exponent_ - exponent(key), 31);
    return ((fraction << (29 - fraction_bits_)) >> below_top ^ sign) - sign;
  }

  std::uint32_t bucket(std::int32_t key) const {
    const std::int32_t at = fixed_point(std::min(std::max(key, min_key_), max_key_));
    const std::uint32_t position = (static_cast<std::uint32_t>(at) - static_cast<std::uint32_t>(first_)) >> shift_;
    return position * factor_ >> 16;
  }

  int fraction_bits_ = 0;  // 0: keys are linear
  std::int32_t min_key_ = 0, max_key_ = 0;
  std::int32_t top_exponent_ = 0;
  std::int32_t first_ = 0;
  int shift_ = 0;
  std::uint32_t factor_ = 0;
  std::uint32_t count_ = 1;
};

/// A set on its way into sweep order.
struct Unordered {
  Span<const Record> records;
  std::int32_t* lo = nullptr;  // on the sweep axis
  std::int32_t* hi = nullptr;
  std::uint32_t* lo_bucket = nullptr;
  std::uint32_t* hi_bucket = nullptr;
  std::uint32_t* start = nullptr;  // per bucket: position of its first box; one more at the end
};

HWY_ATTR Unordered extract(Span<const Record> records, int axis, Arena& arena) {
  Unordered set;
  set.records = records;
  const std::size_t n = records.size();
  set.lo = arena.allocate<std::int32_t>(n);
  set.hi = arena.allocate<std::int32_t>(n);
  for (std::size_t i = 0; i < n; ++i) {
    set.lo[i] = records[i].lo[axis];
    set.hi[i] = records[i].hi[axis];
  }
  return set;
}

HWY_ATTR void key_range(const Unordered& set, std::int32_t& min_key, std::int32_t& max_key) {
  std::int32_t lowest = min_key, highest = max_key;
  for (std::size_t i = 0; i < set.records.size(); ++i) {
    lowest = std::min(lowest, set.lo[i]);
    highest = std::max(highest, set.lo[i]);
  }
  min_key = lowest;
  max_key = highest;
}

/// Counts boxes per bucket; returns the sum of squares, which is about twice the comparisons within buckets.
HWY_ATTR std::uint64_t count_buckets(Unordered& set, const Buckets& buckets, Arena& arena) {
  const std::size_t n = set.records.size();
  set.lo_bucket = arena.allocate<std::uint32_t>(n);
  set.hi_bucket = arena.allocate<std::uint32_t>(n);
  set.start = arena.allocate<std::uint32_t>(buckets.count() + 2);
  buckets.locate(set.lo, n, set.lo_bucket);
  buckets.locate(set.hi, n, set.hi_bucket);
  std::fill_n(set.start, buckets.count() + 2, 0u);
  for (std::size_t i = 0; i < n; ++i) ++set.start[set.lo_bucket[i]];
  std::uint32_t sum = 0;
  std::uint64_t squares = 0;
  for (std::uint32_t b = 0; b < buckets.count() + 2; ++b) {
    const std::uint32_t count = set.start[b];
    squares += std::uint64_t{count} * count;
    set.start[b] = sum;
    sum += count;
  }
  return squares;
}

/// The arrays of an Ordered while they are written.
struct OrderedWriter {
  OrderedWriter(std::size_t boxes, Arena& arena) : size(boxes) {
    const std::size_t room = boxes + padding;
    for (int d = 0; d < 3; ++d) {
      lo[d] = arena.allocate<std::int32_t>(room);
      hi[d] = arena.allocate<std::int32_t>(room);
      std::fill_n(lo[d] + boxes, padding, INT32_MAX);
      std::fill_n(hi[d] + boxes, padding, INT32_MIN);
    }
    id = arena.allocate<std::uint32_t>(room);
    before = arena.allocate<std::uint32_t>(room);
    std::fill_n(id + boxes, padding, 0u);
    std::fill_n(before + boxes, padding, 0u);
    first_run = arena.allocate<std::uint32_t>(boxes);
    end_run = arena.allocate<std::uint32_t>(boxes);
  }

  void put(std::size_t at, const Record& r) {
    for (int d = 0; d < 3; ++d) {
      lo[d][at] = r.lo[d];
      hi[d][at] = r.hi[d];
    }
    id[at] = r.id;
    before[at] = r.before;
  }

  Ordered done() const {
    Ordered o;
    o.size = size;
    for (int d = 0; d < 3; ++d) {
      o.lo[d] = lo[d];
      o.hi[d] = hi[d];
    }
    o.id = id;
    o.before = before;
    o.first_run = first_run;
    o.end_run = end_run;
    return o;
  }

  std::size_t size;
  std::int32_t* lo[3];
  std::int32_t* hi[3];
  std::uint32_t* id;
  std::uint32_t* before;
  std::uint32_t* first_run;
  std::uint32_t* end_run;
};

/// Puts a set in the order of its buckets. Runs are over `other` (which may be the set itself): from the box's own
/// bucket on, or from the next one if `after_own`.
HWY_ATTR Ordered order_by_bucket(const Unordered& set, const Unordered& other, bool after_own, std::uint32_t buckets,
                                 Arena& arena) {
  OrderedWriter out(set.records.size(), arena);
  std::uint32_t* cursor = arena.allocate<std::uint32_t>(buckets + 1);
  std::copy_n(set.start, buckets + 1, cursor);
  for (std::size_t i = 0; i < set.records.size(); ++i) {
    const std::uint32_t at = cursor[set.lo_bucket[i]]++;
    out.put(at, set.records[i]);
    out.first_run[at] = other.start[set.lo_bucket[i] + (after_own ? 1 : 0)];
    out.end_run[at] = other.start[set.hi_bucket[i] + 1];
  }
  return out.done();
}

HWY_ATTR std::uint64_t* sorted_lows(const Unordered& set, Arena& arena) {
  const std::size_t n = set.records.size();
  auto* order = arena.allocate<std::uint64_t>(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = ranked(set.lo[i], i);
  std::sort(order, order + n);
  return order;
}

/// The same as order_by_bucket with every key its own bucket: for sets that even buckets do not part.
HWY_ATTR Ordered order_by_sort(const Unordered& set, const std::uint64_t* order, const Unordered& other,
                               const std::uint64_t* other_order, bool after_own, Arena& arena) {
  OrderedWriter out(set.records.size(), arena);
  const std::size_t m = other.records.size();
  for (std::size_t at = 0; at < set.records.size(); ++at) {
    const std::uint32_t i = position_of(order[at]);
    out.put(at, set.records[i]);
    out.first_run[at] = static_cast<std::uint32_t>(count_below(other_order, m, set.lo[i], after_own));
    out.end_run[at] = static_cast<std::uint32_t>(count_below(other_order, m, set.hi[i], true));
  }
  return out.done();
}

enum class Emit { sorted, run_second, run_first };

/// Tests box `at` of `set` against positions [first, last) of `other` on all axes and emits what overlaps.
template <Emit emit>
HWY_INLINE bool scan_run(const Ordered& set, std::size_t at, const Ordered& other, std::size_t first, std::size_t last,
                         PairBuffer& pairs) {
  const hn::ScalableTag<std::int32_t> d;
  const hn::ScalableTag<std::uint32_t> du;
  const std::size_t lanes = hn::Lanes(d);
  const auto lo0 = hn::Set(d, set.lo[0][at]), hi0 = hn::Set(d, set.hi[0][at]);
  const auto lo1 = hn::Set(d, set.lo[1][at]), hi1 = hn::Set(d, set.hi[1][at]);
  const auto lo2 = hn::Set(d, set.lo[2][at]), hi2 = hn::Set(d, set.hi[2][at]);
  const auto before = hn::Set(du, set.before[at]);
  const auto id = hn::Set(du, set.id[at]);
  for (std::size_t j = first; j < last; j += lanes) {
    // Boxes at and beyond `last` begin above the end of this one, so the comparisons themselves refuse them.
    const auto apart =
        hn::Or(hn::Or(hn::Or(hn::Gt(hn::LoadU(d, other.lo[0] + j), hi0), hn::Gt(lo0, hn::LoadU(d, other.hi[0] + j))),
                      hn::Or(hn::Gt(hn::LoadU(d, other.lo[1] + j), hi1), hn::Gt(lo1, hn::LoadU(d, other.hi[1] + j)))),
               hn::Or(hn::Gt(hn::LoadU(d, other.lo[2] + j), hi2), hn::Gt(lo2, hn::LoadU(d, other.hi[2] + j))));
    const auto not_owned = hn::RebindMask(d, hn::Ne(hn::And(hn::LoadU(du, other.before + j), before), hn::Zero(du)));
    const auto hit = hn::RebindMask(du, hn::Not(hn::Or(apart, not_owned)));
    if (HWY_LIKELY(hn::AllFalse(du, hit))) continue;
    const std::size_t count = hn::CountTrue(du, hit);
    const auto found = hn::Compress(hn::LoadU(du, other.id + j), hit);
    auto* out = reinterpret_cast<std::uint32_t*>(pairs.end());
    if constexpr (emit == Emit::sorted)
      hn::StoreInterleaved2(hn::Min(id, found), hn::Max(id, found), du, out);
    else if constexpr (emit == Emit::run_second)
      hn::StoreInterleaved2(id, found, du, out);
    else
      hn::StoreInterleaved2(found, id, du, out);
    pairs.add(count);
    if (HWY_UNLIKELY(pairs.full()) && !pairs.flush()) return false;
  }
  return true;
}

/// Sweeps every box of `set` over its run of `other`.
template <Emit emit>
HWY_ATTR bool scan_set(const Ordered& set, const Ordered& other, SweepContext& context) {
  for (std::size_t at = 0; at < set.size; ++at) {
    const std::size_t first = set.first_run[at], last = set.end_run[at];
    if (first >= last) continue;
    context.tests += last - first;
    if (!scan_run<emit>(set, at, other, first, last, context.pairs)) return false;
  }
  return true;
}

HWY_ATTR bool scan_self(const Ordered& set, SweepContext& context) {
  for (std::size_t at = 0; at + 1 < set.size; ++at) {
    const std::size_t last = set.end_run[at];
    if (at + 1 >= last) continue;
    context.tests += last - (at + 1);
    if (!scan_run<Emit::sorted>(set, at, set, at + 1, last, context.pairs)) return false;
  }
  return true;
}

// Boxes per bucket to aim for: about the lanes of one wide comparison, of which a run wastes half.
constexpr std::size_t boxes_per_bucket = 8;
// Comparisons per box within its own bucket beyond which sorting is cheaper (a sort costs some 30 ns a box, a wide
// comparison about 2 ns).
constexpr std::size_t most_own_bucket_tests = 64;

std::uint32_t bucket_count(std::size_t boxes) {
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(boxes / boxes_per_bucket, 1, std::size_t{1} << 20));
}

/// Buckets for keys in [min_key, max_key], the low ends of a leaf, of which those beyond the typical range are too few
/// to get buckets of their own.
Buckets make_buckets(const SweepPlan& plan, const SweepContext& context, std::int32_t min_key, std::int32_t max_key,
                     std::size_t boxes) {
  return Buckets(context.kinds[plan.axis], std::max(min_key, plan.typical_min), std::min(max_key, plan.typical_max),
                 bucket_count(boxes));
}

HWY_ATTR bool SweepSelf(Span<const Record> records, const SweepPlan& plan, SweepContext& context) {
  Arena::Frame frame(context.arena);
  Unordered set = extract(records, plan.axis, context.arena);
  std::int32_t min_key = INT32_MAX, max_key = INT32_MIN;
  key_range(set, min_key, max_key);
  const Buckets buckets = make_buckets(plan, context, min_key, max_key, records.size());
  const std::uint64_t squares = count_buckets(set, buckets, context.arena);
  if (squares / 2 <= records.size() * most_own_bucket_tests)
    return scan_self(order_by_bucket(set, set, false, buckets.count(), context.arena), context);
  const std::uint64_t* order = sorted_lows(set, context.arena);
  return scan_self(order_by_sort(set, order, set, order, false, context.arena), context);
}

HWY_ATTR bool SweepCross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan, SweepContext& context) {
  Arena& arena = context.arena;
  Arena::Frame frame(arena);
  Unordered set_a = extract(a, plan.axis, arena), set_b = extract(b, plan.axis, arena);
  std::int32_t min_key = INT32_MAX, max_key = INT32_MIN;
  key_range(set_a, min_key, max_key);
  key_range(set_b, min_key, max_key);
  const Buckets buckets = make_buckets(plan, context, min_key, max_key, std::max(a.size(), b.size()));
  count_buckets(set_a, buckets, arena);
  count_buckets(set_b, buckets, arena);
  std::uint64_t same_bucket = 0;
  for (std::uint32_t i = 0; i < buckets.count(); ++i)
    same_bucket += std::uint64_t{set_a.start[i + 1] - set_a.start[i]} * (set_b.start[i + 1] - set_b.start[i]);
  Ordered ordered_a, ordered_b;
  if (same_bucket <= (a.size() + b.size()) * most_own_bucket_tests) {
    ordered_a = order_by_bucket(set_a, set_b, false, buckets.count(), arena);
    ordered_b = order_by_bucket(set_b, set_a, true, buckets.count(), arena);
  } else {
    const std::uint64_t* order_a = sorted_lows(set_a, arena);
    const std::uint64_t* order_b = sorted_lows(set_b, arena);
    ordered_a = order_by_sort(set_a, order_a, set_b, order_b, false, arena);
    ordered_b = order_by_sort(set_b, order_b, set_a, order_a, true, arena);
  }
  if (context.order == PairOrder::smaller_first)
    return scan_set<Emit::sorted>(ordered_a, ordered_b, context) &&
           scan_set<Emit::sorted>(ordered_b, ordered_a, context);
  return scan_set<Emit::run_second>(ordered_a, ordered_b, context) &&
         scan_set<Emit::run_first>(ordered_b, ordered_a, context);
}

HWY_ATTR void Classify(const std::int32_t* HWY_RESTRICT lo, const std::int32_t* HWY_RESTRICT hi, std::size_t count,
                       Span<const std::int32_t> splitters, std::uint8_t* HWY_RESTRICT first_slab,
                       std::uint8_t* HWY_RESTRICT last_slab) {
  // Counting the splitters below costs two comparisons each, for all lanes at once, and has no branch to mispredict.
  constexpr std::size_t block = 64;
  const hn::ScalableTag<std::int32_t> d;
  const std::size_t lanes = hn::Lanes(d);
  HWY_ALIGN std::int32_t slabs[2][block + padding];
  HWY_ALIGN std::int32_t keys[2][block + padding] = {};
  for (std::size_t begin = 0; begin < count; begin += block) {
    const std::size_t size = std::min(block, count - begin);
    std::copy_n(lo + begin, size, keys[0]);
    std::copy_n(hi + begin, size, keys[1]);
    for (int side = 0; side < 2; ++side)
      for (std::size_t i = 0; i < size; i += lanes) {
        const auto key = hn::Load(d, keys[side] + i);
        auto slab = hn::Zero(d);
        for (const std::int32_t splitter : splitters)  // key >= splitter, in the comparison that integers have
          slab = hn::Sub(slab, hn::VecFromMask(d, hn::Gt(key, hn::Set(d, splitter - 1))));
        hn::Store(slab, d, slabs[side] + i);
      }
    for (std::size_t i = 0; i < size; ++i) {
      first_slab[begin + i] = static_cast<std::uint8_t>(slabs[0][i]);
      last_slab[begin + i] = static_cast<std::uint8_t>(slabs[1][i]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(SweepSelf);
HWY_EXPORT(SweepCross);
HWY_EXPORT(Classify);

bool sweep_self(Span<const Record> records, const SweepPlan& plan, SweepContext& context) {
  return HWY_DYNAMIC_DISPATCH(SweepSelf)(records, plan, context);
}

bool sweep_cross(Span<const Record> a, Span<const Record> b, const SweepPlan& plan, SweepContext& context) {
  return HWY_DYNAMIC_DISPATCH(SweepCross)(a, b, plan, context);
}

void classify(const std::int32_t* lo, const std::int32_t* hi, std::size_t count, Span<const std::int32_t> splitters,
              std::uint8_t* first_slab, std::uint8_t* last_slab) {
  HWY_DYNAMIC_DISPATCH(Classify)(lo, hi, count, splitters, first_slab, last_slab);
}

}  // namespace boxstream::detail

namespace boxstream {
const char* simd_target() {
  return hwy::TargetName(hwy::SupportedTargets() & -hwy::SupportedTargets());
}
}  // namespace boxstream
#endif
