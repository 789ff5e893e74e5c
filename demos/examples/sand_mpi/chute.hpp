// SPDX-License-Identifier: MIT
// Grains, and what they do to each other. Lengths are in diameters of the largest grain; weights and gravity are 1.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

struct Vec {
  double x, y, z;
};
inline Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec operator*(double s, Vec a) {
  return {s * a.x, s * a.y, s * a.z};
}
inline double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

struct Grain {
  Vec at, speed;
  double radius;
};

/// In 2^-32: sums of whole numbers do not depend on their order, and so the run not on the number of ranks.
struct Force {
  std::int64_t x = 0, y = 0, z = 0;

  void add(const Force& f, int sign = 1) { x += sign * f.x, y += sign * f.y, z += sign * f.z; }
  static Force of(Vec f) {
    return {std::llround(f.x * 0x1p32), std::llround(f.y * 0x1p32), std::llround(f.z * 0x1p32)};
  }
  Vec value() const { return 0x1p-32 * Vec{double(x), double(y), double(z)}; }
};

inline std::uint64_t hash(std::uint64_t x) {
  x = (x ^ (x >> 31)) * 0x7fb5d329728ea185;
  x = (x ^ (x >> 27)) * 0x81dadef4bc2dd44d;
  return x ^ (x >> 33);
}

/// A chute that goes down by three in four, between two plates. Sand lies in it against a gate at x = 0, and is let go.
struct Chute {
  explicit Chute(std::uint64_t grains)
      : layers(std::max<std::uint64_t>(4, std::uint64_t(std::cbrt(double(grains) / 4)))),
        length(double((grains + layers * layers - 1) / (layers * layers))),
        stiffness(4 * double(layers)),
        damping(0.5 * std::sqrt(stiffness)),
        dt(0.25 / std::sqrt(stiffness)),
        steps(std::uint64_t(1.8 * std::sqrt(double(layers)) / dt)) {}

  /// At rest, in layers as wide as they are many; along the chute in the order of their numbers.
  Grain start(std::uint64_t id) const {
    const std::uint64_t seed = hash(id + 1);
    const auto shaken = [&](std::uint64_t cell, int bits) {
      return double(cell) + 0.45 + 0.1 * double(seed >> bits & 65535) / 65536;
    };
    const Vec at{shaken(id / (layers * layers), 0), shaken(id % layers, 16), shaken(id / layers % layers, 32)};
    return {at, {}, 0.5 - 0.1 * double(seed >> 48) / 65536};
  }

  /// What `b` does to `a`: a spring, a dashpot, and friction of up to half of these.
  Force contact(const Grain& a, const Grain& b) const {
    const Vec way = a.at - b.at;
    const double distance = std::sqrt(dot(way, way)), reach = a.radius + b.radius;
    if (distance >= reach || distance == 0) return {};
    const Vec normal = (1 / distance) * way, speed = a.speed - b.speed, slip = speed - dot(speed, normal) * normal;
    const double push = std::max(0.0, stiffness * (reach - distance) - damping * dot(speed, normal));
    const double drag = std::min(damping, 0.5 * push / std::sqrt(dot(slip, slip)));
    return Force::of(push * normal - drag * slip);
  }

  /// Gate, ground and plates act as grains that stand still behind them.
  void move(Grain& grain, Force force) const {
    const auto [x, y, z] = grain.at;
    for (const Vec& behind : {Vec{-0.5, y, z}, Vec{x, y, -0.5}, Vec{x, -0.5, z}, Vec{x, double(layers) + 0.5, z}})
      force.add(contact(grain, {behind, {}, 0.5}));
    grain.speed = grain.speed + dt * (force.value() + Vec{0.6, 0, -0.8});
    grain.at = grain.at + dt * grain.speed;
  }

  std::uint64_t layers;
  double length, stiffness, damping, dt;
  std::uint64_t steps;
};
