// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <stdexcept>

#include <boxstream/detector.hpp>

// What JavaScript gives, as what the library takes: the same bytes.
namespace boxstream::javascript {

static_assert(sizeof(Aabb) == 6 * sizeof(float) && sizeof(Aabb64) == 6 * sizeof(double));

enum Scalar : int { float32 = 0, float64 = 1, int32 = 2 };

/// Of all but boxes of searches, which may be of int32: see `boxes_of`.
inline void check(Scalar scalar) {
  if (scalar != float32 && scalar != float64) throw std::invalid_argument("a scalar is 0, float32, or 1, float64");
}

/// Calls `use(float{})` or `use(double{})`.
template <class Use>
auto with_scalar(Scalar scalar, Use use) {
  check(scalar);
  return scalar == float32 ? use(float{}) : use(double{});
}

/// Boxes of one of the types, integers among them.
inline BoxSpan boxes_of(Scalar scalar, const void* data, std::size_t count) {
  if (scalar == int32) return BoxSpan(static_cast<const IntAabb*>(data), count);
  return with_scalar(scalar, [&](auto s) { return BoxSpan(static_cast<const BasicAabb<decltype(s)>*>(data), count); });
}

template <class T>
Span<const T> view(const void* data, std::size_t count) {
  return {static_cast<const T*>(data), count};
}

/// One for each element, or none.
template <class T>
Span<const T> view_or_none(const void* data, std::size_t count) {
  return view<T>(data, data == nullptr ? 0 : count);
}

}  // namespace boxstream::javascript
