// SPDX-License-Identifier: MIT
#include "formats/import/solid.hpp"

#include <algorithm>
#include <unordered_map>

#include "formats/import/frame.hpp"

namespace boxstream::imports {

Solid measure(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Solid solid;
  if (triangles.empty()) return solid;
  // Signed tetrahedra from a corner of the body itself, so that a place far away costs no digits.
  const Vec3& apex = vertices[triangles[0][0]];
  double six_times = 0;
  Vec3 moment{};
  for (const auto& t : triangles) {
    const Vec3 a = minus(vertices[t[0]], apex), b = minus(vertices[t[1]], apex), c = minus(vertices[t[2]], apex);
    const double six = dot(a, cross(b, c));
    six_times += six;
    moment = plus(moment, times(plus(a, plus(b, c)), six));
  }
  solid.volume = six_times / 6;
  solid.centroid = six_times == 0 ? apex : plus(apex, times(moment, 1 / (4 * six_times)));
  return solid;
}

bool is_closed(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::unordered_map<std::uint64_t, int> balance;
  for (const auto& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = t[i], to = t[(i + 1) % 3];
      balance[std::min(from, to) << 32 | std::max(from, to)] += from < to ? 1 : -1;
    }
  }
  return std::all_of(balance.begin(), balance.end(), [](const auto& edge) { return edge.second == 0; });
}

}  // namespace boxstream::imports
