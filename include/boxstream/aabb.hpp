// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace boxstream {

/// An axis-aligned bounding box: the closed set { x : min[d] <= x[d] <= max[d] for d = 0, 1, 2 }.
/// Coordinates are in the caller's unit. Infinite bounds are legal.
/// A box with a NaN or with min > max on some axis is *invalid*: it overlaps nothing, itself included.
template <class S>
struct BasicAabb {
  S min[3];
  S max[3];
};

using Aabb = BasicAabb<float>;
using Aabb64 = BasicAabb<double>;
/// Of voxels, layouts, intervals: for searches of batches. Those of 64 bits within +-2^53.
using IntAabb = BasicAabb<std::int32_t>;
using IntAabb64 = BasicAabb<std::int64_t>;

/// False for boxes with a NaN coordinate or min > max on some axis.
template <class S>
constexpr bool is_valid(const BasicAabb<S>& box) {
  // A number equals itself; to ask that of a NaN is no invalid operation, as to ask for its order is.
  for (int d = 0; d < 3; ++d)
    if (!(box.min[d] == box.min[d] && box.max[d] == box.max[d] && box.min[d] <= box.max[d])) return false;
  return true;
}

/// True when the closed boxes share at least one point: six comparisons, no tolerance.
/// For valid boxes only; an inverted box can look as if it overlapped something.
template <class S>
constexpr bool overlaps(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  return a.min[0] <= b.max[0] && b.min[0] <= a.max[0] &&  //
         a.min[1] <= b.max[1] && b.min[1] <= a.max[1] &&  //
         a.min[2] <= b.max[2] && b.min[2] <= a.max[2];
}

/// The smallest box that contains two valid boxes.
template <class S>
constexpr BasicAabb<S> merged(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  BasicAabb<S> m{};
  for (int d = 0; d < 3; ++d) {
    m.min[d] = b.min[d] < a.min[d] ? b.min[d] : a.min[d];
    m.max[d] = b.max[d] > a.max[d] ? b.max[d] : a.max[d];
  }
  return m;
}

/// The valid `box` grown by `margin` (in the unit of the coordinates, >= 0) on all six sides. Bounds that would leave
/// the range are infinite.
template <class S>
constexpr BasicAabb<S> expanded(const BasicAabb<S>& box, S margin) {
  constexpr S most = std::numeric_limits<S>::max(), inf = std::numeric_limits<S>::infinity();
  if (!(margin == margin && margin > 0)) return box;
  // Nothing is subtracted that would overflow, in any rounding mode: hosts may trap that.
  const S least = margin - most;
  BasicAabb<S> e{};
  for (int d = 0; d < 3; ++d) {
    e.min[d] = box.min[d] <= least ? -inf : box.min[d] - margin;
    e.max[d] = box.max[d] >= -least ? inf : box.max[d] + margin;
  }
  return e;
}

/// The smallest box of floats that contains `box`: low ends are rounded down and high ends up, in any rounding mode, so
/// boxes that overlap still do. Invalid boxes stay invalid, except inverted ones whose inversion is too small for a
/// float.
inline Aabb rounded_outwards(const Aabb64& box) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  Aabb out{};
  for (int d = 0; d < 3; ++d) {
    const auto low = static_cast<float>(box.min[d]), high = static_cast<float>(box.max[d]);
    out.min[d] = low > box.min[d] ? std::nextafter(low, -inf) : low;
    out.max[d] = high < box.max[d] ? std::nextafter(high, inf) : high;
  }
  return out;
}

/// True when both boxes have the same bounds, bit for bit but for the sign of zero. False if either has a NaN.
template <class S>
constexpr bool operator==(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  for (int d = 0; d < 3; ++d)
    if (!(a.min[d] == b.min[d] && a.max[d] == b.max[d])) return false;
  return true;
}

template <class S>
constexpr bool operator!=(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  return !(a == b);
}

}  // namespace boxstream
