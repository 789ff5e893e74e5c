// SPDX-License-Identifier: MIT
#include "grain.hpp"

#include <algorithm>

namespace boxstream::picture {
namespace {

constexpr int reach = 3;  // pixels to each side: a mean over at most 49 of them
// Below this, grain is invisible: a third of a step of an 8-bit colour.
constexpr float invisible_variance = 1e-6F;
// Differences at which a neighbour counts no more. Of albedo and normal: as lengths of vectors.
constexpr float other_albedo = 0.06F, other_normal = 0.25F;
constexpr float other_plane = 3;  // footprints between it and the plane of this pixel
constexpr float other_light = 3;  // standard deviations of the two colours' difference

float squared(float x) {
  return x * x;
}
float squared_length(Vec3 v) {
  return dot(v, v);
}

/// 1 for the pixel itself, 0 for what has another surface or another light.
float likeness(const Pixel& here, const Pixel& there) {
  const float surface = squared_length(here.albedo - there.albedo) / squared(other_albedo) +
                        squared_length(here.normal - there.normal) / squared(other_normal) +
                        squared(dot(here.normal, there.position - here.position) / (other_plane * here.footprint));
  const float grain = here.variance + there.variance + invisible_variance;
  const float light = squared(brightness(here.colour) - brightness(there.colour)) / (squared(other_light) * grain);
  return squared(std::max(0.0F, 1 - surface - light));
}

}  // namespace

Vec3 without_grain(const PixelGrid& grid, int x, int y) {
  const Pixel& here = grid.at(x, y);
  if (here.variance < invisible_variance || here.footprint <= 0) return here.colour;
  Vec3 sum;
  float weight = 0;
  for (int v = std::max(0, y - reach); v <= std::min(grid.height - 1, y + reach); ++v)
    for (int u = std::max(0, x - reach); u <= std::min(grid.width - 1, x + reach); ++u) {
      const float w = likeness(here, grid.at(u, v));
      sum = sum + grid.at(u, v).colour * w;
      weight += w;
    }
  return sum * (1 / weight);
}

}  // namespace boxstream::picture
