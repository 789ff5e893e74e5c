// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vec3.hpp"

namespace boxstream::picture {

/// Of a linear colour.
constexpr float brightness(Vec3 c) {
  return 0.2126F * c.x + 0.7152F * c.y + 0.0722F * c.z;
}

/// What the samples of a pixel say, on average. Without a hit all but the colour is zero.
struct Pixel {
  Vec3 colour;            ///< as shown, linear
  Vec3 albedo;            ///< of what is seen
  Vec3 normal, position;  ///< likewise
  float footprint = 0;    ///< how wide the pixel is there
  float variance = 0;     ///< of the colour's brightness, as a mean of samples
};

struct PixelGrid {
  int width, height;
  std::vector<Pixel> pixels;

  const Pixel& at(int x, int y) const {
    return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

/// The colour of a pixel without the grain that few samples of light leave: a mean over those around it that see the
/// same surface, and whose colours differ by no more than grain does. Edges of things and of shadows stay.
Vec3 without_grain(const PixelGrid& grid, int x, int y);

}  // namespace boxstream::picture
