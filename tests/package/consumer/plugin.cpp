// SPDX-License-Identifier: MIT
#include <boxstream/boxstream.hpp>

std::size_t count_pairs();

std::size_t count_pairs() {
  const boxstream::Aabb boxes[] = {{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}};
  return boxstream::find_pairs(boxes).size();
}
