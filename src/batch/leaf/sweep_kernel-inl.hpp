// SPDX-License-Identifier: MIT
//
// The sweep itself.

#if defined(BOXSTREAM_SWEEP_KERNEL_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_SWEEP_KERNEL_INL_HPP_
#undef BOXSTREAM_SWEEP_KERNEL_INL_HPP_
#else
#define BOXSTREAM_SWEEP_KERNEL_INL_HPP_
#endif

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "base/thresholds.hpp"
#include "batch/leaf/sweep.hpp"
#include "batch/leaf/sweep_emit-inl.hpp"
#include "batch/leaf/sweep_exact-inl.hpp"
#include "batch/leaf/sweep_order-inl.hpp"
#include "batch/records/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

/// Lanes of a block that may overlap a box: the block is of the set and the box another, or the box is of the set and
/// the block another.
struct alignas(16) Hit {
  std::uint32_t set;    // position of the box, or of the block's first
  std::uint32_t other;  // the same
  std::uint32_t mask;   // bit i: lane i
};

/// Which of the boxes of a set come before one of another set that they may overlap: what a sweep is made of.
/// Between two sets each pair is found by the box that begins first; within a set, by the one that comes first.
///
/// First the finding: hits are only noted, at a pace that does not depend on how many there are. Then, for many hits at
/// a time, the close look. So neither has branches that depend on where boxes happen to overlap.
template <Emit emit, bool is_self>
class Sweep {
 public:
  Sweep(Ordered& set, Ordered& other, SweepContext& context, Ties ties = Ties::kept)
      : set_(set),
        other_(other),
        no_ties_(ties == Ties::dropped ? 1 : 0),
        pairs_(context.pairs),
        hits_(context.arena.allocate<Hit>(room_for_hits)),
        found_(context.arena.allocate<Found>(most_found)),
        arena_(context.arena),
        doubtful_(context.originals.doubtful_axes()),
        doubted_before_(context.pairs.doubted()) {}

  /// Upper bound of the comparisons of a run.
  HWY_ATTR std::uint64_t most_tests(std::size_t begin, std::size_t end) const {
    std::uint64_t most = 0;
    for (std::size_t at = begin; at < end; at += block) {
      const auto [first, last] = window_of(at);
      most += first < last ? (last - first) * block : 0;
    }
    return most;
  }

  /// Finds what boxes [begin, end) of the set overlap. Within a set, both are the set's ends or multiples of blocks.
  /// False when the buffer's owner wants to stop.
  HWY_ATTR bool run(std::size_t begin, std::size_t end, std::uint64_t& tests) {
    assert(begin <= end && end <= set_.size && hit_count_ == 0);
    assert(!is_self || (begin % block == 0 && (end % block == 0 || end == set_.size)));
    for (; begin + block <= end || (begin < end && end == set_.size); begin += block)
      if (!sweep_block(begin, tests)) return false;
    if (!test_hits<false>()) return false;
    for (; begin < end; ++begin)  // boxes behind these are another run's
      if (!sweep_alone(begin, other_.begin_of(set_.lo[begin], no_ties_ != 0), other_.end_of(set_.hi[begin]), tests))
        return false;
    return test_hits<!is_self>();
  }

 private:
  static constexpr std::size_t hits_at_once = PairBuffer::slack;
  static constexpr std::size_t most_hits = thresholds.most_hits;
  static constexpr std::size_t window = most_hits / 2;  // positions looked at before the hits are counted again
  static constexpr std::size_t room_for_hits = most_hits + 2 * window;
  static constexpr std::size_t eager = 2;
  static constexpr std::size_t most_found = hits_at_once * eager + eager;
  static_assert(window >= block);  // room for the hits of a block in itself, and in the window after it

  using Found = Pair;

  /// Positions of the other set.
  struct Window {
    std::size_t first, last;
  };

  HWY_INLINE Window window_of(std::size_t at) const {
    const D d;
    auto highest = hn::LoadU(d, set_.hi + at), lowest = hn::LoadU(d, set_.lo + at);
    for (std::size_t k = 1; k < vectors; ++k) {
      highest = hn::Max(highest, hn::LoadU(d, set_.hi + at + k * lanes));
      lowest = hn::Min(lowest, hn::LoadU(d, set_.lo + at + k * lanes));
    }
    return {is_self ? at + 1 : other_.begin_of(hn::GetLane(hn::MinOfLanes(d, lowest)), no_ties_ != 0),
            other_.end_of(hn::GetLane(hn::MaxOfLanes(d, highest)))};
  }

  HWY_INLINE bool sweep_block(std::size_t at, std::uint64_t& tests) {
    const auto [first, last] = window_of(at);
    if (first >= last) return true;
    assert(last <= other_.size);
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
      if (hit_count_ >= most_hits && !test_hits<false>()) return false;
    }
    return hit_count_ < most_hits || test_hits<false>();
  }

  // What a block costs for a position of its window; what a box alone costs to begin, and for a position.
  // In 1/24 of a nanosecond, about.
  static constexpr std::size_t block_position = 24;
  static constexpr std::size_t run_begin = 120;
  static constexpr std::size_t run_position = 1;
  static constexpr std::size_t longest_window = thresholds.longest_window * block;

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
    if (!is_self && !test_hits<false>()) return false;
    for (std::size_t i = 0; i < in_block; ++i) {
      const std::size_t begin = std::max<std::size_t>(window_end, run_first[i]);
      if (!sweep_alone(at + i, begin, run_last[i], tests)) return false;
    }
    return is_self || test_hits<true>();
  }

  /// One box against others from `begin` on.
  HWY_INLINE bool sweep_alone(std::size_t at, std::size_t begin, std::size_t end, std::uint64_t& tests) {
    tests += begin < end ? end - begin : 0;
    for (; begin < end; begin += window * block) {
      find_in_run(at, begin, std::min<std::size_t>(begin + window * block, end));
      if (hit_count_ >= most_hits && !test_hits<!is_self>()) return false;
    }
    return true;
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
      lo[k] = hn::Add(hn::LoadU(d, set_.lo + at + k * lanes), hn::Set(d, no_ties_));
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
        mask |= bits_of(du, hn::AndNot(hn::RebindMask(du, begins_outside(o_lo, lo[k], hi[k])),
                                       may_overlap(o_packed, packed[k])))
                << (k * lanes);
      if constexpr (triangle) mask &= (std::uint32_t{1} << (j - at)) - 1;
      *hit = {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(j), mask};
      hit += mask != 0 ? 1 : 0;
    }
    hit_count_ = static_cast<std::size_t>(hit - hits_);
    assert(hit_count_ < room_for_hits);
  }

  /// Notes which blocks of boxes [first, last) of the other set, and some beyond, box `at` may overlap.
  HWY_INLINE void find_in_run(std::size_t at, std::size_t first, std::size_t last) {
    const D d;
    const DU du;
    const auto packed = opposite(hn::Set(du, set_.packed[at]));
    const auto lo = hn::Set(d, set_.lo[at] + no_ties_), hi = hn::Set(d, set_.hi[at]);
    Hit* hit = hits_ + hit_count_;
    for (std::size_t j = first; j < last; j += block) {
      std::uint32_t mask = 0;
      for (std::size_t k = 0; k < vectors; ++k) {
        const std::size_t i = j + k * lanes;
        mask |= bits_of(du, hn::AndNot(hn::RebindMask(du, begins_outside(hn::LoadU(d, other_.lo + i), lo, hi)),
                                       may_overlap(hn::LoadU(du, other_.packed + i), packed)))
                << (k * lanes);
      }
      // Within a set it does not matter which is which, and then the lanes are the set's as in a window.
      if constexpr (is_self)
        *hit = {static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(at), mask};
      else
        *hit = {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(j), mask};
      hit += mask != 0 ? 1 : 0;
    }
    hit_count_ = static_cast<std::size_t>(hit - hits_);
    assert(hit_count_ < room_for_hits);
  }

  /// Within a set, a later box may begin before if they share a bucket, and still overlap.
  static HWY_INLINE M begins_outside(V other_lo, V lo, V hi) {
    const auto beyond = hn::Gt(other_lo, hi);
    return is_self ? beyond : hn::Or(beyond, hn::Gt(lo, other_lo));
  }

  /// Emits those of the hits that are pairs. Never inlined: it is called once for many hits, from many places.
  template <bool is_run>
  HWY_NOINLINE HWY_ATTR bool test_hits() {
    for (std::size_t begin = 0; begin < hit_count_; begin += hits_at_once) {
      if (doubtful_ != 0 && set_.exact == nullptr) make_exact_if_it_pays(hits_[begin].set);
      part_by_density<is_run>(hits_ + begin, std::min(hits_at_once, hit_count_ - begin));
      if (!emit_sparse() || !emit_dense<is_run>()) return false;
    }
    hit_count_ = 0;
    return true;
  }

  /// Hits with many lanes are left for emit_dense, others for emit_sparse, lane by lane. The same number of lanes of
  /// each is written whether it has them or not, for how many it has is unpredictable.
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
    assert(count <= hits_at_once && found_count_ <= eager * hits_at_once);
    dense_ = {hits, dense};
  }

  template <bool is_run>
  HWY_INLINE bool emit_dense() {
    if (dense_.empty()) return true;
    dense_count_ += dense_.size();
    if (is_exact()) return emit_lane_by_lane<is_run>();
    if (dense_count_ * thresholds.hits_for_columns <= dense_[dense_.size() - 1].set) return emit_lane_by_lane<is_run>();
    const Columns& many = is_run ? columns(other_, other_columns_) : columns(set_, set_columns_);
    const Record* const ones = is_run ? set_.records : other_.records;
    for (const Hit& hit : dense_) {
      const Record& one = ones[is_run ? hit.set : hit.other];
      const std::size_t at = is_run ? hit.other : hit.set;
      Pair* out = pairs_.end();
      for (std::size_t k = 0; k < vectors; ++k)
        out = put<emit, is_run>(one, many, at + k * lanes, hit.mask >> (k * lanes), out);
      if (doubtful_ != 0 && out != pairs_.end() && shares_key(one, many, at, doubtful_))
        pairs_.doubt(pairs_.end(), out);
      pairs_.set_end(out);
      if (HWY_UNLIKELY(out >= pairs_.limit()) && !pairs_.flush()) return false;
    }
    return true;
  }

  /// While dense hits are so few that columns for them do not pay, or if keys do not decide.
  template <bool is_run>
  HWY_NOINLINE HWY_ATTR bool emit_lane_by_lane() {
    found_count_ = 0;
    for (const Hit& hit : dense_) {
      if (found_count_ > most_found - block) {
        if (!emit_sparse()) return false;
        found_count_ = 0;
      }
      const DU du;
      for (std::size_t k = 0; k < vectors; ++k) {
        const std::uint32_t bits = hit.mask >> (k * lanes);
        const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
        const auto mask = hn::LoadMaskBits(du, bytes);
        const auto first = static_cast<std::uint32_t>((is_run ? hit.other : hit.set) + k * lanes);
        const auto many = compressed(du, hn::Add(hn::Iota(du, 0), hn::Set(du, first)), mask),
                   one = hn::Set(du, is_run ? hit.set : hit.other);
        const std::size_t count = hn::CountTrue(du, mask);
        store(is_run ? one : many, is_run ? many : one, count, found_ + found_count_);
        found_count_ += count;
      }
    }
    return emit_sparse();
  }

  /// Where keys lost bits and do not decide, the boxes themselves do: a few pairs are confirmed when they are handed
  /// over; where there are many, all pairs of the leaf here, by records with all bits, for which each box is read once.
  void make_exact_if_it_pays(std::size_t swept) {
    const std::uint64_t doubts = pairs_.doubted() - doubted_before_;
    if (doubts < thresholds.least_doubts || doubts * thresholds.boxes_for_doubt < swept || set_.originals == nullptr)
      return;
    set_.exact = gather_exact(set_.records, set_.size, set_.originals, arena_);
    if (!is_self) other_.exact = gather_exact(other_.records, other_.size, other_.originals, arena_);
  }

  const Columns& columns(const Ordered& set, Columns& made) {
    if (made.id == nullptr) made = make_columns(set.records, set.size + block, arena_);
    return made;
  }

  /// What decides whether boxes overlap.
  enum class Look { keys, keys_with_doubts, exact };

  bool is_exact() const { return doubtful_ != 0 && set_.exact != nullptr; }

  HWY_INLINE bool emit_sparse() {
    if (is_exact()) return emit_found<Look::exact>(set_.exact, other_.exact);
    return doubtful_ == 0 ? emit_found<Look::keys>(set_.records, other_.records)
                          : emit_found<Look::keys_with_doubts>(set_.records, other_.records);
  }

  template <Look look, class R>
  HWY_INLINE bool emit_found(const R* set_records, const R* other_records) {
    const std::size_t count = found_count_;
    for (std::size_t begin = 0; begin < count; begin += PairBuffer::slack) {
      const Span<const Found> found(found_ + begin, std::min(count - begin, PairBuffer::slack));
      SharedKeys shared;
      Pair* out = emit_some<look>(found, set_records, other_records, shared);
      if constexpr (look == Look::keys_with_doubts) {
        if (HWY_UNLIKELY(shared.on(doubtful_))) doubt_sharing(found);  // of most, one look at all is enough
      }
      pairs_.set_end(out);
      if (HWY_UNLIKELY(out >= pairs_.limit()) && !pairs_.flush()) return false;
    }
    return true;
  }

  template <Look look, class R>
  HWY_INLINE Pair* emit_some(Span<const Found> found, const R* set_records, const R* other_records,
                             SharedKeys& shared) {
    Pair* out = pairs_.end();
    for (const Found f : found) {
      const R &set = set_records[f.a], &other = other_records[f.b];
      if constexpr (emit == Emit::sorted)
        *out = sorted(set.id, other.id);
      else if constexpr (emit == Emit::set_first)
        *out = {set.id, other.id};
      else
        *out = {other.id, set.id};
      if constexpr (look == Look::keys_with_doubts) shared.add(set, other);
      out += is_pair(set, other) ? 1 : 0;
    }
    return out;
  }

  /// Those of the pairs written last.
  HWY_NOINLINE HWY_ATTR void doubt_sharing(Span<const Found> found) {
    const Pair* pair = pairs_.end();
    for (const Found f : found) {
      const Record &set = set_.records[f.a], &other = other_.records[f.b];
      const std::size_t pairs = is_pair(set, other) ? 1 : 0;
      pairs_.doubt_if((shares_key(set, other, doubtful_) ? 1 : 0) & pairs, pair);
      pair += pairs;
    }
  }

  /// The smaller first; without the branch that a compiler may make of min and max, for it is unpredictable.
  static HWY_INLINE Pair sorted(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t swap = (a ^ b) & (0u - static_cast<std::uint32_t>(b < a));
    return {a ^ swap, b ^ swap};
  }

  Ordered& set_;
  Ordered& other_;
  const std::int32_t no_ties_;  // 1: boxes that begin at the same key are left to another sweep
  PairBuffer& pairs_;
  Hit* hits_;
  Found* found_;
  Arena& arena_;
  const std::uint32_t doubtful_;  // axes on which a shared key does not decide
  const std::uint64_t doubted_before_;
  std::size_t hit_count_ = 0;
  std::size_t found_count_ = 0;
  std::size_t dense_count_ = 0;
  Span<const Hit> dense_;
  Columns set_columns_, other_columns_;  // made when they are needed
};

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
