// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "image.hpp"

namespace boxstream::picture {

/// Writes an 8-bit RGB PNG. Throws std::runtime_error naming the file and the reason; a partial file may remain.
void write_png(const Image& image, const std::string& path);

/// Reads a PNG of any colour type as RGB (alpha is dropped). Throws std::runtime_error.
Image read_png(const std::string& path);

}  // namespace boxstream::picture
