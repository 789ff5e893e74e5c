// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "bvh/ray_slabs.hpp"

namespace boxstream::detail {

/// An eighth of the sum of a box's sides, each bound cut to finite numbers: differences neither overflow nor become
/// NaN. A heuristic measure of size, for judging trees only.
template <class S>
S girth(const BasicAabb<S>& box) {
  constexpr S most = std::numeric_limits<S>::max();
  const auto eighth = [](S x) { return (x < -most ? -most : x > most ? most : x) / 8; };
  S sum = 0;
  for (int d = 0; d < 3; ++d) sum += eighth(box.max[d]) - eighth(box.min[d]);
  return sum;
}

/// Eight boxes side by side, tested at once by loops that compilers turn into vector code. An empty lane is inverted
/// (lo = +inf, hi = -inf): it adds nothing to bounds, and tests reject it by one more comparison instead of by NaNs.
template <class S>
struct alignas(64) BoxBlock {
  static constexpr unsigned width = 8;
  using Mask = unsigned;  // bit i = lane i

  S lo[3][width];
  S hi[3][width];

  BoxBlock() {
    for (unsigned i = 0; i < width; ++i) clear(i);
  }

  void clear(unsigned lane) {
    constexpr S inf = std::numeric_limits<S>::infinity();
    for (int d = 0; d < 3; ++d) {
      lo[d][lane] = inf;
      hi[d][lane] = -inf;
    }
  }

  /// An invalid box empties the lane.
  void set(unsigned lane, const BasicAabb<S>& box) {
    if (!is_valid(box)) return clear(lane);
    for (int d = 0; d < 3; ++d) {
      lo[d][lane] = box.min[d];
      hi[d][lane] = box.max[d];
    }
  }

  bool has_box(unsigned lane) const { return lo[0][lane] <= hi[0][lane]; }

  BasicAabb<S> get(unsigned lane) const {
    return {{lo[0][lane], lo[1][lane], lo[2][lane]}, {hi[0][lane], hi[1][lane], hi[2][lane]}};
  }

  /// True if `get(lane)` would give these bounds, which may be inverted.
  bool holds(unsigned lane, const BasicAabb<S>& box) const {
    bool equal = true;
    for (int d = 0; d < 3; ++d) equal &= (lo[d][lane] == box.min[d]) & (hi[d][lane] == box.max[d]);
    return equal;
  }

  /// Of all lanes; inverted if they are all empty.
  BasicAabb<S> bounds() const {
    BasicAabb<S> b{};
    for (int d = 0; d < 3; ++d) {
      S least = lo[d][0];
      S most = hi[d][0];
      for (unsigned i = 1; i < width; ++i) {
        least = lo[d][i] < least ? lo[d][i] : least;
        most = most < hi[d][i] ? hi[d][i] : most;
      }
      b.min[d] = least;
      b.max[d] = most;
    }
    return b;
  }

  /// By how much the girth of each lane would grow to take `box` in.
  void find_growth(const BasicAabb<S>& box, S (&grown)[width]) const {
    constexpr S most = std::numeric_limits<S>::max();
    const auto eighth = [](S x) { return (x < -most ? -most : x > most ? most : x) / 8; };
    for (unsigned i = 0; i < width; ++i) grown[i] = 0;
    for (int d = 0; d < 3; ++d)
      for (unsigned i = 0; i < width; ++i) {
        const bool is_empty = lo[d][i] > hi[d][i];
        const S low = box.min[d] < lo[d][i] ? box.min[d] : lo[d][i],
                high = hi[d][i] < box.max[d] ? box.max[d] : hi[d][i];
        const S now = is_empty ? 0 : eighth(hi[d][i]) - eighth(lo[d][i]);
        grown[i] += eighth(high) - eighth(low) - now;
      }
  }

  Mask filled() const {
    Word bits = 0;
    for (unsigned i = 0; i < width; ++i) bits |= lo[0][i] <= hi[0][i] ? bit(i) : 0;
    return static_cast<Mask>(bits);
  }

  /// Lanes that the ray meets at 0 <= t <= length, and where it enters them.
  Mask hit(const RaySlabs<S>& ray, S length, S (&enter)[width]) const {
    S leave[width];
    Word in[width];
    for (unsigned i = 0; i < width; ++i) {
      enter[i] = 0;
      leave[i] = length;
      in[i] = lo[0][i] <= hi[0][i] ? bit(i) : 0;
    }
    for (int d = 0; d < 3; ++d) {
      if (ray.parallel[d]) {
        for (unsigned i = 0; i < width; ++i) {
          const S below = lo[d][i] - ray.reach_lo[d] - ray.origin[d];
          const S above = hi[d][i] - ray.reach_hi[d] - ray.origin[d];
          in[i] = ((below > 0) | (above < 0)) ? 0 : in[i];
        }
        continue;
      }
      const bool backwards = ray.inverse[d] < 0;
      const S* near_bound = backwards ? hi[d] : lo[d];
      const S* far_bound = backwards ? lo[d] : hi[d];
      const S near_reach = backwards ? ray.reach_hi[d] : ray.reach_lo[d];
      const S far_reach = backwards ? ray.reach_lo[d] : ray.reach_hi[d];
      // A comparison with NaN (infinity minus itself, or times zero) is false and leaves the interval as it is.
      const auto cut = [&](unsigned i, S t_near, S t_far) {
        enter[i] = t_near > enter[i] ? t_near : enter[i];
        leave[i] = t_far < leave[i] ? t_far : leave[i];
      };
      if (ray.is_long[d])
        for (unsigned i = 0; i < width; ++i)
          cut(i, ray.far_crossing(near_bound[i], near_reach, d), ray.far_crossing(far_bound[i], far_reach, d));
      else
        for (unsigned i = 0; i < width; ++i)
          cut(i, (near_bound[i] - near_reach - ray.origin[d]) * ray.inverse[d],
              (far_bound[i] - far_reach - ray.origin[d]) * ray.inverse[d]);
    }
    Word bits = 0;
    for (unsigned i = 0; i < width; ++i) bits |= enter[i] <= leave[i] ? in[i] : 0;
    return static_cast<Mask>(bits);
  }

 private:
  // As wide as S, so that a comparison's result is a mask of the same width.
  using Word = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
  static constexpr Word bit(unsigned i) { return Word{1} << i; }
};

/// Blocks of a few boxes, `box_of(i)` as number i, in memory of their own. In the default floating-point environment.
template <class S, std::size_t most>
class FewBlocks {
 public:
  static constexpr unsigned width = BoxBlock<S>::width;

  template <class BoxOf>
  FewBlocks(std::size_t boxes, BoxOf&& box_of) : count_((boxes + width - 1) / width) {
    for (std::size_t i = 0; i < count_; ++i) new (&blocks_[i]) BoxBlock<S>;
    for (std::size_t i = 0; i < boxes; ++i) blocks_[i / width].set(static_cast<unsigned>(i % width), box_of(i));
  }

  const BoxBlock<S>* data() const { return blocks_; }
  std::size_t count() const { return count_; }

 private:
  static_assert(most % width == 0);

  std::size_t count_;
  union {
    BoxBlock<S> blocks_[most / width];  // constructed only as far as there are boxes
  };
};

}  // namespace boxstream::detail
