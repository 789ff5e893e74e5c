// SPDX-License-Identifier: MIT
#include "formats/import/principal.hpp"

#include <cmath>
#include <numbers>

namespace boxstream::imports {
namespace {

constexpr Tensor units{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Vec3 product(const Tensor& tensor, const Vec3& v) {
  return {dot(tensor[0], v), dot(tensor[1], v), dot(tensor[2], v)};
}

/// Its entries along the axes that `turn` makes of x, y and z.
Tensor along_axes(const Tensor& tensor, const Quat& turn) {
  Tensor seen{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      seen[i][j] = dot(turned(turn, units[i]), product(tensor, turned(turn, units[j])));
  return seen;
}

/// About axis r by the angle that makes the entry of the two others vanish.
Quat jacobi_turn(const Tensor& tensor, std::size_t r) {
  const std::size_t p = (r + 1) % 3, q = (r + 2) % 3;
  const double twice = 2 * tensor[p][q], difference = tensor[p][p] - tensor[q][q];
  double angle = 0;
  if (twice != 0) angle = difference == 0 ? std::numbers::pi / 4 : std::atan(twice / difference) / 2;
  Quat turn{0, 0, 0, std::cos(angle / 2)};
  turn[r] = std::sin(angle / 2);
  return turn;
}

}  // namespace

Tensor sum(const Tensor& a, const Tensor& b) {
  return {plus(a[0], b[0]), plus(a[1], b[1]), plus(a[2], b[2])};
}

Tensor turned(const Quat& turn, const Tensor& tensor) {
  return along_axes(tensor, {-turn[0], -turn[1], -turn[2], turn[3]});
}

Tensor of_point(double mass, const Vec3& place) {
  Tensor tensor{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      tensor[i][j] = mass * ((i == j ? dot(place, place) : 0.0) - place[i] * place[j]);
  return tensor;
}

Principal principal(const Tensor& tensor) {
  Quat turn{0, 0, 0, 1};
  Tensor seen = tensor;
  constexpr int enough = 12;  // sweeps; each squares what is left beside the diagonal
  for (int sweep = 0; sweep < enough; ++sweep) {
    for (std::size_t r = 0; r < 3; ++r) {
      turn = product(turn, jacobi_turn(seen, r));
      seen = along_axes(tensor, turn);
    }
  }
  return {{seen[0][0], seen[1][1], seen[2][2]}, turn};
}

}  // namespace boxstream::imports
