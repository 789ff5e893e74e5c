// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace boxstream::detail {

/// Makes room for one more element, growing geometrically: the push that follows cannot throw.
template <class T, class A>
void reserve_one_more(std::vector<T, A>& v) {
  if (v.size() == v.capacity()) v.reserve(v.size() < 8 ? 16 : 2 * v.size());
}

/// As reserve_one_more, for `count` pushes.
template <class T, class A>
void reserve_more(std::vector<T, A>& v, std::size_t more) {
  if (v.capacity() - v.size() < more) v.reserve(std::max<std::size_t>({16, v.size() + more, 2 * v.capacity()}));
}

}  // namespace boxstream::detail
