// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <new>
#include <type_traits>

#include <boxstream/aabb.hpp>
#include <boxstream/ray.hpp>
#include <boxstream/span.hpp>

namespace boxstream::detail {

/// A ray as slabs see it: for each axis, t where the ray crosses a bound = (bound - reach - origin) * inverse.
/// Every step is monotone in the bound, rounding included, so a box that contains another is never missed where the
/// inner one is hit.
template <class S>
struct RaySlabs {
  S origin[3];
  S inverse[3];
  S length;       // at most the largest finite number, so that a crossing at infinity is a miss
  S reach_lo[3];  // the lower bound is taken at lo - reach_lo
  S reach_hi[3];
  bool parallel[3];  // infinite inverse, or one of zero: the axis only says inside or outside
  bool is_long[3];   // distances that overflow may be within the length
  bool hits_nothing;

  explicit RaySlabs(const BasicRay<S>& ray) {
    constexpr S finite = std::numeric_limits<S>::max();
    length = ray.length < finite ? ray.length : finite;
    hits_nothing = !(ray.length >= 0);
    std::copy_n(ray.origin, 3, origin);
    std::copy_n(ray.inverse_direction, 3, inverse);
    std::copy_n(ray.extent_max, 3, reach_lo);
    std::copy_n(ray.extent_min, 3, reach_hi);
    for (int d = 0; d < 3; ++d) parallel[d] = is_long[d] = false;
    if (!is_ordinary()) look_closer();
  }

  /// A box that meets each box that the ray meets by the tests below: all its points, and more than these round. May be
  /// invalid, which says nothing.
  BasicAabb<S> swept() const {
    constexpr S rounding = 16 * std::numeric_limits<S>::epsilon();
    const auto size = [](S x) { return x < 0 ? -x : x; };
    BasicAabb<S> box;
    for (int d = 0; d < 3; ++d) {
      const S way = parallel[d] ? 0 : (length + std::numeric_limits<S>::min()) / inverse[d];
      const S slack = rounding * (size(origin[d]) + size(way) + size(reach_lo[d]) + size(reach_hi[d]));
      box.min[d] = origin[d] + (way < 0 ? way : 0) + reach_hi[d] - slack;
      box.max[d] = origin[d] + (way < 0 ? 0 : way) + reach_lo[d] + slack;
    }
    return box;
  }

  /// True for a box that is swept, which seldom goes far.
  bool has_extent() const {
    bool is_point = true;
    for (int d = 0; d < 3; ++d) is_point &= reach_lo[d] == reach_hi[d];
    return !is_point;
  }

  /// t at a bound on an axis that is long: what overflows on the way is a quarter of itself there.
  S far_crossing(S bound, S reach, unsigned d) const {
    constexpr S most = std::numeric_limits<S>::max();
    const S distance = bound - reach - origin[d];
    const S quarter = bound / 4 - reach / 4 - origin[d] / 4;
    return distance <= most && distance >= -most ? distance * inverse[d] : quarter * (4 * inverse[d]);
  }

 private:
  /// No axis is parallel or long, and all are numbers. Most rays are, and what makes others special takes longer to
  /// tell than a few boxes to test.
  bool is_ordinary() const {
    constexpr S quarter = std::numeric_limits<S>::max() / 4, inf = std::numeric_limits<S>::infinity();
    const auto size = [](S x) { return x < 0 ? -x : x; };
    for (int d = 0; d < 3; ++d) {
      const S turns = size(inverse[d]);
      const bool is_slanted = turns > 0 && turns < inf;
      // A product that overflows would raise a flag, and to take it back takes longer than all of this.
      const bool is_near = size(origin[d]) <= quarter && length <= quarter * (turns < 1 ? turns : 1);
      const bool is_number = reach_lo[d] == reach_lo[d] && reach_hi[d] == reach_hi[d];
      if (!(is_slanted && is_near && is_number)) return false;
    }
    return true;
  }

  void look_closer() {
    constexpr S finite = std::numeric_limits<S>::max();
    constexpr S inf = std::numeric_limits<S>::infinity();
    for (const S x : inverse) length = x == 0 && length > 0 ? 0 : length;
    for (int d = 0; d < 3; ++d) {
      parallel[d] = inverse[d] == inf || inverse[d] == -inf || inverse[d] == 0;  // the last: it goes nowhere
      const S turns = inverse[d] < 0 ? -inverse[d] : inverse[d];
      const bool is_point = reach_lo[d] == 0 && reach_hi[d] == 0;
      is_long[d] = length > (is_point ? finite : finite / 4) * turns ||
                   (!is_point && (origin[d] > finite / 4 || origin[d] < -finite / 4));
      const bool is_number = origin[d] == origin[d] && inverse[d] == inverse[d] && reach_lo[d] == reach_lo[d] &&
                             reach_hi[d] == reach_hi[d];
      hits_nothing = hits_nothing || !is_number;
    }
  }
};

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
    for (unsigned d = 0; d < 3; ++d) {
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
