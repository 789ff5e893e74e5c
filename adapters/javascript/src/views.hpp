// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <boxstream/world.hpp>

// What JavaScript gives, as what the library takes: the same bytes.
namespace boxstream::javascript {

static_assert(sizeof(Aabb) == 6 * sizeof(float) && sizeof(Aabb64) == 6 * sizeof(double));

enum Scalar : int { float32 = 0, float64 = 1 };

/// Calls `use(float{})` or `use(double{})`.
template <class Use>
auto with_scalar(Scalar scalar, Use use) {
  return scalar == float32 ? use(float{}) : use(double{});
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
