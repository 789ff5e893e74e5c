// SPDX-License-Identifier: MIT
#include "papers/volumes/tightness.hpp"

#include <algorithm>
#include <queue>
#include <vector>

namespace boxstream::papers::volumes {
namespace {

struct Cell {
  Point middle, half;  ///< in the frame
  double bound;        ///< no distance in the cell is above it

  friend bool operator<(const Cell& a, const Cell& b) { return a.bound < b.bound; }
};

}  // namespace

double directed_hausdorff(const Frame& frame, FunctionRef<double(const Point&)> excess,
                          FunctionRef<double(const Point&)> distance, double tolerance) {
  double reached = 0;
  std::priority_queue<Cell> cells;
  const auto add = [&](const Point& middle, const Point& half) {
    const Point p = frame.centre + frame.axes * middle;
    const double radius = half.norm(), outside = excess(p);
    if (outside > radius * (1 + slack)) return;
    const double d = distance(p);
    if (outside <= 0) reached = std::max(reached, d);
    cells.push({middle, half, d + radius});
  };
  add(Point::Zero(), frame.half);
  while (!cells.empty()) {
    const Cell cell = cells.top();
    cells.pop();
    if (cell.bound <= reached + tolerance) break;
    // Middles of cells may go on missing a B that is flat; but it has a point near this one.
    if (cell.half.norm() <= tolerance / 4) return std::max(reached, cell.bound - tolerance);
    Eigen::Index axis = 0;
    Point half = cell.half;
    half.maxCoeff(&axis);
    half[axis] /= 2;
    const Point step = half[axis] * Point::Unit(axis);
    add(cell.middle - step, half);
    add(cell.middle + step, half);
  }
  return reached;
}

}  // namespace boxstream::papers::volumes
