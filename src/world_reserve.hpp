// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace boxstream::detail {

/// Makes room for one more element, growing geometrically: the push that follows cannot throw.
template <class T>
void reserve_one_more(std::vector<T>& v) {
  if (v.size() == v.capacity()) v.reserve(v.size() < 8 ? 16 : 2 * v.size());
}

}  // namespace boxstream::detail
