// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "base/bits.hpp"
#include "base/keys.hpp"
#include "base/thresholds.hpp"
#include "bvh/bvh_block.hpp"

namespace boxstream::detail {

/// Where the keys of few boxes lie: a column for each bound, as long as all others, with inert lanes at its end.
template <class Key>
struct FewColumns {
  Key* lo[3];
  Key* hi[3];
};

/// The keys of a box.
template <class S>
struct BoxKeys {
  using Key = decltype(order_key(S()));

  /// As a run of numbers, of which compilers make vectors.
  explicit BoxKeys(const BasicAabb<S>& box) {
    std::array<S, 6> of_box;
    static_assert(sizeof(of_box) == sizeof(box));
    std::memcpy(&of_box, &box, sizeof(box));
    for (int i = 0; i < 6; ++i) bounds[i] = order_key(of_box[i]);
  }

  Key lo(int d) const { return bounds[d]; }
  Key hi(int d) const { return bounds[3 + d]; }

  /// As has_valid_keys.
  bool are_valid() const {
    constexpr auto infinity = static_cast<Key>(infinity_key<S>);
    for (int d = 0; d < 3; ++d)
      if (lo(d) > hi(d) || lo(d) < ~infinity || hi(d) > infinity) return false;
    return true;
  }

  Key bounds[6];  // lower ones, upper ones
};

/// The boxes of few proxies once more, as columns of keys, for vectors to compare a box or a ray with all of them. They
/// follow each change at once, so that there is nothing to bring up to date, and no lock. Boxes that are not valid are
/// inert: they meet nothing.
template <class S>
class FewBoxes {
 public:
  using Box = BasicAabb<S>;
  using Key = decltype(order_key(S()));

  /// As many fit, and take so many words of a bit each.
  static constexpr std::size_t most = thresholds.few_proxies;
  static constexpr std::size_t most_words = bit_words(most), most_lanes = 64 * most_words;

  FewBoxes() = default;
  FewBoxes(const FewBoxes&) = delete;
  FewBoxes& operator=(const FewBoxes&) = delete;

  /// False once there have been more. Then nothing else is to be called but `keep`.
  bool is_kept() const { return is_kept_; }
  void drop() noexcept {
    std::vector<Key>().swap(keys_);
    lanes_ = 0;
    is_kept_ = false;
  }
  /// These boxes are all, with room for `size`. May throw.
  void keep(Span<const Box> boxes, std::size_t size) {
    if (size > lanes_) resize(boxes, std::min(std::max(size, 2 * lanes_), most));
    is_kept_ = true;
  }
  /// Gives back room for more than these. May throw.
  void shrink_to_fit(Span<const Box> boxes) {
    if (is_kept_ && lanes_of(boxes.size()) < lanes_) resize(boxes, boxes.size());
  }

  /// Of a valid box, or of none.
  void set(std::uint32_t rank, const BoxKeys<S>& box) noexcept {
    assert(rank < lanes_);
    for (int d = 0; d < 3; ++d) {
      columns_.lo[d][rank] = box.lo(d);
      columns_.hi[d][rank] = box.hi(d);
    }
  }
  void set_inert(std::uint32_t rank) noexcept {
    assert(rank < lanes_);
    columns_.lo[0][rank] = std::numeric_limits<Key>::max();
    columns_.hi[0][rank] = std::numeric_limits<Key>::min();
  }
  /// Those of the ranks from `first` on, up to `end`, of all boxes.
  void load(Span<const Box> boxes, std::size_t first, std::size_t end) noexcept;
  /// From this rank on there are none.
  void cut(std::size_t rank) noexcept {
    for (; rank < lanes_; ++rank) set_inert(static_cast<std::uint32_t>(rank));
  }

  /// A bit for each of the first `size` ranks whose box meets this one, which is valid. Returns how many words they
  /// are.
  std::size_t find_touching(const BoxKeys<S>& box, std::size_t size, std::uint64_t* bits) const;

  /// The same for one of them. An inert one meets none.
  void find_row(std::uint32_t rank, std::size_t size, std::uint64_t* bits) const;

  /// Of each of the first `size` ranks the bits of those behind it that meet it, in rows of `bit_words(size)` words.
  /// Bits up to its own, and words before that, may be any.
  void find_rows(std::size_t size, std::uint64_t* rows) const;

  /// The same of those that a ray meets, and where it enters them: see BoxBlock::hit. Not for a ray that `is_long` on
  /// any axis, and in the default floating-point environment.
  std::size_t find_hits(const RaySlabs<S>& ray, std::size_t size, S (&enter)[most_lanes], std::uint64_t* bits) const;

  /// Throws std::logic_error if these are not the boxes. Inert ones are those for which `is_valid(rank)` is false.
  template <class IsValid>
  bool are(Span<const Box> boxes, IsValid&& is_valid) const {
    for (std::uint32_t rank = 0; rank < lanes_; ++rank) {
      const bool is_inert = columns_.lo[0][rank] > columns_.hi[0][rank];
      if (is_inert != (rank >= boxes.size() || !is_valid(rank))) return false;
      for (int d = 0; d < 3 && !is_inert; ++d)
        if (columns_.lo[d][rank] != order_key(boxes[rank].min[d]) ||
            columns_.hi[d][rank] != order_key(boxes[rank].max[d]))
          return false;
    }
    return lanes_ >= boxes.size();
  }

 private:
  static constexpr std::size_t line = 64 / sizeof(Key);

  /// Whole vectors of every target, of which none has more than a cache line.
  static constexpr std::size_t lanes_of(std::size_t size) { return (size + line - 1) / line * line; }
  void resize(Span<const Box> boxes, std::size_t size);

  bool is_kept_ = true;
  std::size_t lanes_ = 0;  // whole vectors
  FewColumns<Key> columns_{};
  std::vector<Key> keys_;  // what the columns are in
};

extern template class FewBoxes<float>;
extern template class FewBoxes<double>;

}  // namespace boxstream::detail
