// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace boxstream::picture {

/// Rows from the top, 3 bytes (sRGB red, green, blue) a pixel, no padding.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Writes an 8-bit RGB PNG. Throws std::runtime_error if it cannot be made; whether it was written `out` knows.
void write_png(const Image& image, std::ostream& out);

/// Reads a PNG of any colour type as RGB (alpha is dropped). Throws std::runtime_error.
Image read_png(const std::string& path);

}  // namespace boxstream::picture
