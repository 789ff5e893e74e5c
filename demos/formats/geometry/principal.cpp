// SPDX-License-Identifier: MIT
#include "formats/geometry/principal.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace boxstream::geometry {
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

/// What rounding leaves beside the diagonal, of the largest entry. Axes of equal moments would turn anywhere for it.
constexpr double nothing = 1e-6;

bool is_diagonal(const Tensor& tensor) {
  const double most = std::max({std::abs(tensor[0][0]), std::abs(tensor[1][1]), std::abs(tensor[2][2])});
  return std::max({std::abs(tensor[0][1]), std::abs(tensor[0][2]), std::abs(tensor[1][2])}) <= nothing * most;
}

/// The rotation whose columns these are.
Quat turn_to(const std::array<Vec3, 3>& axes) {
  const auto entry = [&](std::size_t row, std::size_t column) { return axes[column][row]; };
  const double trace = entry(0, 0) + entry(1, 1) + entry(2, 2);
  Quat q{};
  if (trace > 0) {
    const double s = 2 * std::sqrt(1 + trace);
    q = {(entry(2, 1) - entry(1, 2)) / s, (entry(0, 2) - entry(2, 0)) / s, (entry(1, 0) - entry(0, 1)) / s, s / 4};
  } else {
    std::size_t i = 0;
    for (std::size_t other = 1; other < 3; ++other)
      if (entry(other, other) > entry(i, i)) i = other;
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const double s = 2 * std::sqrt(1 + entry(i, i) - entry(j, j) - entry(k, k));
    q[i] = s / 4;
    q[j] = (entry(j, i) + entry(i, j)) / s;
    q[k] = (entry(k, i) + entry(i, k)) / s;
    q[3] = (entry(k, j) - entry(j, k)) / s;
  }
  return q;
}

/// The same axes, each under the name and with the sign that turn it least.
Principal least_turned(const Vec3& moments, const std::array<Vec3, 3>& axes) {
  std::array<std::size_t, 3> order{0, 1, 2}, best = order;
  double most = -1;
  do {
    double along = 0;
    for (std::size_t i = 0; i < 3; ++i) along += std::abs(axes[order[i]][i]);
    if (along > most + 1e-9) most = along, best = order;
  } while (std::next_permutation(order.begin(), order.end()));
  Principal result;
  std::array<Vec3, 3> named{};
  std::size_t loosest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    result.moments[i] = moments[best[i]];
    named[i] = times(axes[best[i]], axes[best[i]][i] < 0 ? -1 : 1);
    if (named[i][i] < named[loosest][loosest]) loosest = i;
  }
  if (dot(cross(named[0], named[1]), named[2]) < 0) named[loosest] = times(named[loosest], -1);
  result.turn = turn_to(named);
  return result;
}

}  // namespace

Tensor sum(const Tensor& a, const Tensor& b) {
  return {plus(a[0], b[0]), plus(a[1], b[1]), plus(a[2], b[2])};
}

Tensor scaled(const Tensor& tensor, double factor) {
  return {times(tensor[0], factor), times(tensor[1], factor), times(tensor[2], factor)};
}

Tensor diagonal(const Vec3& moments) {
  return {{{moments[0], 0, 0}, {0, moments[1], 0}, {0, 0, moments[2]}}};
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
  if (is_diagonal(tensor)) return {{tensor[0][0], tensor[1][1], tensor[2][2]}, {0, 0, 0, 1}};
  Quat turn{0, 0, 0, 1};
  Tensor seen = tensor;
  constexpr int enough = 12;  // sweeps; each squares what is left beside the diagonal
  for (int sweep = 0; sweep < enough; ++sweep) {
    for (std::size_t r = 0; r < 3; ++r) {
      turn = product(turn, jacobi_turn(seen, r));
      seen = along_axes(tensor, turn);
    }
  }
  return least_turned({seen[0][0], seen[1][1], seen[2][2]},
                      {turned(turn, units[0]), turned(turn, units[1]), turned(turn, units[2])});
}

}  // namespace boxstream::geometry
