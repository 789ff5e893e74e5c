// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/export.hpp>

namespace boxstream {

/// Point x is behind the plane when normal . x + offset < 0. The normal need not have unit length; if it is zero, the
/// offset alone decides, for all points. Six inward planes make a view frustum, others any convex region.
template <class S>
struct BasicPlane {
  S normal[3];
  S offset;
};

using Plane = BasicPlane<float>;
using Plane64 = BasicPlane<double>;

/// True when a valid box is wholly behind the plane. It errs on one side only: false for every box that has a point on
/// the plane or before it, in any floating-point environment; also false for boxes that are behind by less than 2^-45
/// of the largest of the terms that normal . x + offset consists of (bounds of less than 2^-126 count as that much
/// there; for double bounds, and components of a normal beside its largest, it is 2^-300).
///
/// A box that is unbounded on the side that the normal points to is never behind. With an offset of -infinity every
/// other box is; a plane with a NaN or another infinity has nothing behind it. Nothing traps.
template <class S>
BOXSTREAM_API bool is_behind(const BasicAabb<S>& box, const BasicPlane<S>& plane);

extern template bool is_behind(const BasicAabb<float>&, const BasicPlane<float>&);
extern template bool is_behind(const BasicAabb<double>&, const BasicPlane<double>&);

}  // namespace boxstream
