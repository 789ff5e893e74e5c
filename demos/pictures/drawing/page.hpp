// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <iosfwd>

#include "canvas.hpp"
#include "poster.hpp"

namespace boxstream::picture {

/// What cairo draws goes to `out`.
SurfacePtr svg_surface(std::ostream& out, double width, double height);
/// Throws std::runtime_error with the reason if something went wrong.
void check(cairo_status_t status);

/// Writes what `draw` draws on a page of that size, a PNG with two pixels a unit. Throws std::runtime_error.
void write_page(std::ostream& out, PictureFormat format, double width, double height,
                const std::function<void(Canvas&)>& draw);

}  // namespace boxstream::picture
