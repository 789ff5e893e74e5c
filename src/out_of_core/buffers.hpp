// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace boxstream::detail {

/// Adds a value to at most `most`, never with more room than they take, and little where they are few.
template <class T>
void append(std::vector<T>& to, const T& value, std::size_t most) {
  if (to.size() == to.capacity()) to.reserve(std::min(most, std::max<std::size_t>(64, 2 * to.size())));
  to.push_back(value);
}

/// Empties it and gives its memory back, which assigning {} does not.
template <class T>
void give_up(std::vector<T>& values) {
  std::vector<T>().swap(values);
}

}  // namespace boxstream::detail
