// SPDX-License-Identifier: MIT
#pragma once

#include "canvas.hpp"
#include "poster.hpp"

namespace boxstream::picture {

/// Draws the chart with its title, legend and axes inside `rect`.
void draw_chart(Canvas& canvas, const Rect& rect, const Chart& chart);

}  // namespace boxstream::picture
