// SPDX-License-Identifier: MIT
#pragma once

#include "poster.hpp"

namespace boxstream::picture {

class Canvas;
struct Rect;

/// Draws the bar along the lower edge of `rect`, from its right end, on a light ground.
void draw_colour_bar(Canvas& canvas, const Rect& rect, const ColourBar& bar);

/// The image with the bar on it.
Image with_colour_bar(const Image& image, const ColourBar& bar);

}  // namespace boxstream::picture
