// SPDX-License-Identifier: MIT
#include "formats/geometry/closed_forms.hpp"

#include <numbers>

namespace boxstream::geometry {
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
