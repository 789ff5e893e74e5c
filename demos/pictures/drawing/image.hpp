// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace boxstream::picture {

/// Rows from the top, 3 bytes (sRGB red, green, blue) a pixel, no padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

}  // namespace boxstream::picture
