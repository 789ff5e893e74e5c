// SPDX-License-Identifier: MIT
#include "papers/volumes/axis_box.hpp"

#include <algorithm>

namespace boxstream::papers::volumes {

AxisBox AxisBox::around(Points points) {
  Point low = points[0], high = points[0];
  for (const Point& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return {{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}}};
}

AxisBox AxisBox::around(Span<const AxisBox> boxes) {
  AxisBox all = boxes[0];
  for (const AxisBox& box : boxes) all.box = merged(all.box, box.box);
  return all;
}

Point AxisBox::centre() const {
  return {(box.min[0] + box.max[0]) / 2, (box.min[1] + box.max[1]) / 2, (box.min[2] + box.max[2]) / 2};
}

double AxisBox::excess(const Point& p) const {
  double excess = 0;
  for (int d = 0; d < 3; ++d) excess = std::max({excess, box.min[d] - p[d], p[d] - box.max[d]});
  return excess;
}

}  // namespace boxstream::papers::volumes
