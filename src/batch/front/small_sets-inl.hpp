// SPDX-License-Identifier: MIT
//
// Very small sets, a lane each: their first boxes are compared with their second ones at once, and so on.

#if defined(BOXSTREAM_SMALL_SETS_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_SMALL_SETS_INL_HPP_
#undef BOXSTREAM_SMALL_SETS_INL_HPP_
#else
#define BOXSTREAM_SMALL_SETS_INL_HPP_
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "batch/records/columns.hpp"
#include "batch/records/columns_load-inl.hpp"
#include "batch/records/pair_buffer.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

constexpr std::size_t most_tiny = thresholds.most_tiny;
constexpr std::size_t pairs_of_tiny = most_tiny * (most_tiny - 1) / 2, pairs_at_once = 4;
static_assert(pairs_of_tiny < 64 && (pairs_of_tiny / pairs_at_once + 1) * pairs_at_once <= PairBuffer::slack);

/// The pairs of a set, in the order in which compare_all comes to them: those with one of the first half block, and
/// others.
constexpr std::size_t pairs_of_first_rows = half_block * (half_block - 1) / 2 + half_block * (most_tiny - half_block);
constexpr std::array<std::uint64_t, 64> make_tiny_pairs() {
  std::array<std::uint64_t, 64> pairs{};
  std::size_t size = 0;
  for (std::uint32_t at = 0; at < most_tiny; at += half_block)
    for (std::uint32_t row = at; row < most_tiny; ++row)
      for (std::uint32_t i = at; i < std::min<std::uint32_t>(row, at + half_block); ++i)
        pairs[size++] = std::bit_cast<std::uint64_t>(Pair{i, row});
  return pairs;
}
constexpr std::array<std::uint64_t, 64> tiny_pairs = make_tiny_pairs();

/// As many sets as there are lanes, or fewer.
template <class S>
class TinyGroup {
  using Key = decltype(order_key(S()));
  using DK = Narrow<Key>;
  static constexpr std::size_t lanes_of_group = hn::MaxLanes(DK());

 public:
  static constexpr std::size_t most_sets = lanes_of_group;

  HWY_INLINE TinyGroup(const BasicAabb<S>* boxes, const std::uint64_t* offsets, std::size_t sets)
      : offsets_(offsets), sets_(sets) {
    for (std::size_t set = 0; set < sets; ++set) size_ = std::max(size_, size_of(set));
    assert(sets <= most_sets && size_ <= most_tiny);
    constexpr S inf = std::numeric_limits<S>::infinity();
    constexpr BasicAabb<S> none{{inf, inf, inf}, {-inf, -inf, -inf}};
    for (std::size_t set = 0; set < lanes_of_group; ++set) {
      const std::size_t size = set < sets ? size_of(set) : 0;
      for (std::size_t i = 0; i < size; ++i) side_by_side_[i * lanes_of_group + set] = boxes[offsets[set] + i];
      for (std::size_t i = size; i < size_; ++i) side_by_side_[i * lanes_of_group + set] = none;
    }
  }

  HWY_INLINE void load(Faces faces, TinyCounts& counts) {
    counts.boxes += static_cast<std::size_t>(offsets_[sets_] - offsets_[0]);
    std::uint32_t one = 0, two = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t at = i * lanes_of_group;
      const std::uint32_t valid = load_some(side_by_side_ + at, lanes_of_group, at, faces, columns_);
      counts.valid += static_cast<std::size_t>(std::popcount(valid));
      two |= one & valid;
      one |= valid;
    }
    counts.sets += static_cast<std::size_t>(std::popcount(two));
  }

  HWY_INLINE void compare() {
    const DK d;
    for (std::size_t at = 0, begin = 0; at < size_; at += half_block, begin = pairs_of_first_rows) {
      std::uint8_t* next = meeting_ + begin;
      for (std::size_t row = at; row < size_; ++row) {
        Bounds<DK> one, other;
        one.load(columns_, row * lanes_of_group);
        for (std::size_t i = at; i < std::min(row, at + half_block); ++i) {
          other.load(columns_, i * lanes_of_group);
          *next++ = static_cast<std::uint8_t>(bits_of(d, hn::Not(one.disjoint(other))));
        }
      }
    }
  }

  /// False when the search is to stop.
  HWY_INLINE bool emit(PairBuffer& pairs) const {
    std::uint64_t found[8] = {};
    transpose(found);
    for (std::size_t set = 0; set < sets_; ++set) {
      const auto begin = static_cast<std::uint32_t>(offsets_[set]);
      const auto first = std::bit_cast<std::uint64_t>(Pair{begin, begin});  // neither sum carries
      Pair* const out = pairs.end();
      std::uint64_t left = found[set];
      const auto count = static_cast<std::size_t>(std::popcount(left));
      for (std::size_t i = 0; i < count; i += pairs_at_once)
        for (std::size_t k = 0; k < pairs_at_once; ++k, left &= left - 1)
          out[i + k] = std::bit_cast<Pair>(first + tiny_pairs[static_cast<std::size_t>(std::countr_zero(left)) % 64]);
      pairs.set_end(out + count);
      if (HWY_UNLIKELY(out + count >= pairs.limit()) && !pairs.flush()) return false;
    }
    return true;
  }

 private:
  std::size_t size_of(std::size_t set) const { return static_cast<std::size_t>(offsets_[set + 1] - offsets_[set]); }

  /// From a byte for each pair, with a bit for each set, to a word for each set.
  HWY_INLINE void transpose(std::uint64_t (&found)[8]) const {
#if HWY_TARGET == HWY_SCALAR
    for (std::size_t k = 0; k < 64; ++k) found[0] |= std::uint64_t{meeting_[k]} << k;
#else
    const hn::CappedTag<std::int8_t, 32> d;
    constexpr std::size_t step = hn::MaxLanes(d);
    for (std::size_t at = 0; at < 64; at += step) {
      auto bytes = hn::Load(d, reinterpret_cast<const std::int8_t*>(meeting_) + at);
      for (std::size_t set = 8; set-- > 0; bytes = hn::Add(bytes, bytes)) {
        std::uint8_t bits[8];
        hn::StoreMaskBits(d, hn::Lt(bytes, hn::Zero(d)), bits);
        for (std::size_t i = 0; i < step / 8; ++i) found[set] |= std::uint64_t{bits[i]} << (at + 8 * i);
      }
    }
#endif
  }

  const std::uint64_t* offsets_;
  std::size_t sets_, size_ = 0;
  BasicAabb<S> side_by_side_[most_tiny * lanes_of_group];
  BoxColumnsOf<Key, 2 * load_block> columns_;
  alignas(64) std::uint8_t meeting_[64] = {};
};

template <class S>
HWY_INLINE void compare_tiny_sets(const BasicAabb<S>* boxes, const std::uint64_t* offsets, std::size_t sets,
                                  Faces faces, PairBuffer& pairs, TinyCounts& counts) {
  for (std::size_t first = 0; first < sets; first += TinyGroup<S>::most_sets) {
    TinyGroup<S> group(boxes, offsets + first, std::min(TinyGroup<S>::most_sets, sets - first));
    group.load(faces, counts);
    group.compare();
    if (!group.emit(pairs)) return;
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
