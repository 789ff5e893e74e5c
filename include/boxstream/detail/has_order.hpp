// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <boxstream/aabb.hpp>

namespace boxstream::detail {

/// True if a box is valid; for the default environment, where comparing a NaN does not trap.
template <class S>
bool has_order(const BasicAabb<S>& box) {
  return (box.min[0] <= box.max[0]) & (box.min[1] <= box.max[1]) & (box.min[2] <= box.max[2]);
}

}  // namespace boxstream::detail
