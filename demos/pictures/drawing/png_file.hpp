// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>

#include "image.hpp"

namespace boxstream::picture {

/// Writes an 8-bit RGB PNG. Throws std::runtime_error if it cannot be made; whether it was written `out` knows.
void write_png(const Image& image, std::ostream& out);

/// Reads a PNG of any colour type as RGB (alpha is dropped). Throws std::runtime_error.
Image read_png(const std::string& path);

}  // namespace boxstream::picture
