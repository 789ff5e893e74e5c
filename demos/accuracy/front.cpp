// SPDX-License-Identifier: MIT
#include "front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace boxstream::accuracy {

std::vector<std::size_t> front(const std::vector<Offer>& offers) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < offers.size(); ++i)
    if (!std::isnan(offers[i].cost) && !std::isnan(offers[i].error)) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return std::pair(offers[x].cost, offers[x].error) < std::pair(offers[y].cost, offers[y].error);
  });
  std::vector<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    if (!(offers[i].error < least)) continue;
    least = offers[i].error;
    best.push_back(i);
  }
  return best;
}

}  // namespace boxstream::accuracy
