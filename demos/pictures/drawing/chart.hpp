// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "poster.hpp"

namespace boxstream::picture {

class Canvas;
struct Rect;

/// What the y axis of a chart goes up to, and what it leaves out.
struct Extent {
  double top;         ///< upper end of the axis; at least 1 where nothing is above 0
  double peak;        ///< largest value
  std::size_t above;  ///< how many values are beyond the top: a few spikes must not flatten all others
};

/// What is far beyond the 99th percentile of all values is clipped there.
Extent y_extent(const Chart& chart);

/// Draws the chart with its title, legend and axes inside `rect`.
void draw_chart(Canvas& canvas, const Rect& rect, const Chart& chart);

}  // namespace boxstream::picture
