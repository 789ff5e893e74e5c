// SPDX-License-Identifier: MIT
#include "formats/geometry/solid.hpp"

#include <algorithm>
#include <numbers>
#include <unordered_map>

#include "formats/geometry/frame.hpp"

namespace boxstream::geometry {

namespace {

/// The integral of x_i x_j over a solid, and the tensor of inertia that comes of it.
Tensor inertia_of(const Tensor& squares) {
  const double all = squares[0][0] + squares[1][1] + squares[2][2];
  return sum(diagonal({all, all, all}), scaled(squares, -1));
}

/// v v^T, added to `squares` this many times.
void add_square(Tensor& squares, const Vec3& v, double factor) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) squares[i][j] += factor * v[i] * v[j];
}

}  // namespace

Solid measure(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  Solid solid;
  if (triangles.empty()) return solid;
  // Signed tetrahedra from a corner of the body itself, so that a place far away costs no digits.
  const Vec3& apex = vertices[triangles[0][0]];
  double six_times = 0;
  Vec3 moment{};
  Tensor squares{};
  for (const auto& t : triangles) {
    const Vec3 a = minus(vertices[t[0]], apex), b = minus(vertices[t[1]], apex), c = minus(vertices[t[2]], apex);
    const double six = dot(a, cross(b, c));
    const Vec3 middle = plus(a, plus(b, c));
    six_times += six;
    moment = plus(moment, times(middle, six));
    for (const Vec3& v : {a, b, c, middle}) add_square(squares, v, six / 120);
  }
  solid.volume = six_times / 6;
  if (six_times == 0) {
    solid.centroid = apex;
    return solid;
  }
  const Vec3 from_apex = times(moment, 1 / (4 * six_times));
  solid.centroid = plus(apex, from_apex);
  add_square(squares, from_apex, -solid.volume);
  solid.inertia = inertia_of(squares);
  return solid;
}

Solid placed(const Frame& place, const Solid& solid) {
  return {solid.volume, place.place(solid.centroid), turned(place.turn, solid.inertia)};
}

Solid sum(const std::vector<Solid>& solids) {
  Solid whole;
  Vec3 moment{};
  for (const Solid& solid : solids) {
    whole.volume += solid.volume;
    moment = plus(moment, times(solid.centroid, solid.volume));
  }
  if (whole.volume == 0) return whole;
  whole.centroid = times(moment, 1 / whole.volume);
  for (const Solid& solid : solids)
    whole.inertia =
        sum(whole.inertia, sum(solid.inertia, of_point(solid.volume, minus(solid.centroid, whole.centroid))));
  return whole;
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

namespace {

constexpr double pi = std::numbers::pi;

/// Moments across and along y.
Tensor round(double across, double along) {
  return diagonal({across, along, across});
}

}  // namespace

Solid box(const Vec3& half_extents) {
  const double x = half_extents[0], y = half_extents[1], z = half_extents[2], volume = 8 * x * y * z;
  return {volume, {}, diagonal(times({y * y + z * z, x * x + z * z, x * x + y * y}, volume / 3))};
}

Solid ball(double radius) {
  const double r2 = radius * radius, volume = 4.0 / 3 * pi * r2 * radius, moment = 0.4 * volume * r2;
  return {volume, {}, diagonal({moment, moment, moment})};
}

Solid cylinder(double radius, double height) {
  const double r2 = radius * radius, volume = pi * r2 * height;
  return {volume, {}, round(volume * (3 * r2 + height * height) / 12, volume * r2 / 2)};
}

Solid capsule(double radius, double height) {
  const Solid middle = cylinder(radius, height), ends = ball(radius);
  // Each half ball has its centre of mass three eighths of the radius beyond the centre of its end.
  const double ends_across = ends.inertia[0][0] + ends.volume * (height * height / 4 + 3.0 / 8 * height * radius);
  return {middle.volume + ends.volume,
          {},
          round(middle.inertia[0][0] + ends_across, middle.inertia[1][1] + ends.inertia[1][1])};
}

Solid cone(double radius, double height) {
  const double r2 = radius * radius, volume = pi * r2 * height / 3;
  return {volume, {0, -height / 4, 0}, round(volume * (3.0 / 20 * r2 + 3.0 / 80 * height * height), 0.3 * volume * r2)};
}

}  // namespace boxstream::geometry
