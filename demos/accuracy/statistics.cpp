// SPDX-License-Identifier: MIT
#include "statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace boxstream::accuracy {

double quantile(std::vector<double> values, double p) {
  const auto at = static_cast<std::ptrdiff_t>(std::ceil(p * static_cast<double>(values.size())) - 1);
  const auto place = values.begin() + std::clamp<std::ptrdiff_t>(at, 0, std::ssize(values) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Estimate estimate(const std::vector<double>& values) {
  constexpr int samples = 2000;
  std::mt19937_64 random(1);
  std::vector<double> medians, sample(values.size());
  for (int i = 0; i < samples; ++i) {
    for (double& value : sample) value = values[random() % values.size()];
    medians.push_back(quantile(sample, 0.5));
  }
  return {quantile(values, 0.5), quantile(medians, 0.025), quantile(medians, 0.975), quantile(values, 0), NAN};
}

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
