// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "canvas.hpp"
#include "poster.hpp"

namespace boxstream::picture {

/// Writes what `draw` draws on a page of that size, a PNG with two pixels a unit. Throws std::runtime_error.
void write_page(const std::string& path, PictureFormat format, double width, double height,
                const std::function<void(Canvas&)>& draw);

}  // namespace boxstream::picture
