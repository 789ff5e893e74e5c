// SPDX-License-Identifier: MIT
#include "experiment_kinds/beside.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace boxstream::report {

double error_at_cost(const std::vector<Point>& points, std::size_t metric, double cost) {
  std::vector<const Point*> usable;
  for (const Point& point : points)
    if (point.failure.empty() && point.cost.median > 0 && point.values[metric] > 0) usable.push_back(&point);
  std::sort(usable.begin(), usable.end(),
            [](const Point* a, const Point* b) { return a->cost.median < b->cost.median; });
  for (std::size_t i = 1; i < usable.size(); ++i) {
    const Point &before = *usable[i - 1], &after = *usable[i];
    if (cost < before.cost.median || cost > after.cost.median) continue;
    const double way = std::log(after.cost.median / before.cost.median);
    const double share = way > 0 ? std::log(cost / before.cost.median) / way : 0;
    return before.values[metric] * std::pow(after.values[metric] / before.values[metric], share);
  }
  return NAN;
}

std::vector<double> errors_beside(const std::string& series, std::size_t metric, const std::vector<Point>& points) {
  std::vector<Point> others;
  std::copy_if(points.begin(), points.end(), std::back_inserter(others),
               [&](const Point& point) { return point.series == series; });
  std::vector<double> ratios;
  for (const Point& point : points)
    ratios.push_back(point.series == series ? NAN
                                            : point.values[metric] / error_at_cost(others, metric, point.cost.median));
  return ratios;
}

}  // namespace boxstream::report
