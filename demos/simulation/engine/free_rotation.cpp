// SPDX-License-Identifier: MIT
#include "simulation/engine/free_rotation.hpp"

#include <algorithm>
#include <cmath>

#include "formats/geometry/frame.hpp"

namespace boxstream::scenes {

using geometry::cross;
using geometry::dot;
using geometry::product;
using geometry::turned;

namespace {

constexpr double most_angle = 0.2;  // rad, of a part of a step
constexpr double most_parts = 256;  // of a step
constexpr int most_iterations = 30;
constexpr double settled = 1e-13;  // a change at which iterations stop, as a share of the angle

Vec3 times_each(const Vec3& a, const Vec3& b) {
  return {a[0] * b[0], a[1] * b[1], a[2] * b[2]};
}

/// Of a vector of a third of a radian at most: series that are exact to rounding there.
Quat small_turn(const Vec3& v) {
  const double a = dot(v, v) / 4;  // the square of half the angle
  const double sine = (1 - a / 6 * (1 - a / 20 * (1 - a / 42 * (1 - a / 72)))) / 2;
  const double cosine = 1 - a / 2 * (1 - a / 12 * (1 - a / 30 * (1 - a / 56 * (1 - a / 90))));
  return {sine * v[0], sine * v[1], sine * v[2], cosine};
}

/// Of length 1, of one that nearly is: a step of Newton's.
void normalise(Quat& q) {
  const double scale = 1.5 - (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]) / 2;
  for (double& x : q) x *= scale;
}

}  // namespace

FreeRotation::FreeRotation(const Vec3& moments)
    : moments_(moments),
      ratios_{(moments[1] - moments[2]) / moments[0], (moments[2] - moments[0]) / moments[1],
              (moments[0] - moments[1]) / moments[2]},
      stiffness_(std::max({1.0, std::abs(ratios_[0]), std::abs(ratios_[1]), std::abs(ratios_[2])})) {}

Vec3 FreeRotation::momentum(const State& state) const {
  return turned(state.rotation, times_each(moments_, state.spin));
}

bool FreeRotation::advance(double dt, State& state) const {
  const double angle = std::sqrt(dot(state.spin, state.spin)) * dt * stiffness_;
  if (!(angle <= most_angle * most_parts)) return false;
  const int parts = std::max(1, static_cast<int>(std::ceil(angle / most_angle)));
  const double part = dt / parts;
  const Vec3 before = momentum(state);
  // In angles a part of the step: Euler's equations have no other unit.
  Vec3 u = times(state.spin, part);
  const auto change = [&](const Vec3& at) {
    return Vec3{ratios_[0] * at[1] * at[2], ratios_[1] * at[2] * at[0], ratios_[2] * at[0] * at[1]};
  };
  const double root = std::sqrt(3.0), near_stage = 0.25 - root / 6, far_stage = 0.25 + root / 6;
  for (int i = 0; i < parts; ++i) {
    const double enough = settled * settled * dot(u, u);
    Vec3 first = change(u), second = first, u1, u2;
    for (int k = 0; k < most_iterations; ++k) {
      for (std::size_t d = 0; d < 3; ++d) {
        u1[d] = u[d] + 0.25 * first[d] + near_stage * second[d];
        u2[d] = u[d] + far_stage * first[d] + 0.25 * second[d];
      }
      const Vec3 next_first = change(u1), next_second = change(u2);
      double moved = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        const double a = next_first[d] - first[d], b = next_second[d] - second[d];
        moved += a * a + b * b;
      }
      first = next_first, second = next_second;
      if (moved <= enough) break;
    }
    // The turn of the two stages, of fourth order as well (Magnus).
    const Vec3 twist = cross(u1, u2);
    Vec3 turn;
    for (std::size_t d = 0; d < 3; ++d) {
      turn[d] = (u1[d] + u2[d]) / 2 + root / 12 * twist[d];
      u[d] += (first[d] + second[d]) / 2;
    }
    state.rotation = product(state.rotation, small_turn(turn));
  }
  state.spin = times(u, 1 / part);
  // Of the momentum the length has stayed; its direction has to the order of the method. The body is turned after it.
  const Vec3 after = momentum(state);
  if (const double square = dot(before, before); square > 0) {
    const Vec3 off = times(cross(after, before), 0.5 / square);
    state.rotation = product({off[0], off[1], off[2], 1}, state.rotation);
  }
  normalise(state.rotation);
  return true;
}

}  // namespace boxstream::scenes
