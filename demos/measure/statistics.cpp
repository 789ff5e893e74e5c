// SPDX-License-Identifier: MIT
#include "measure/statistics.hpp"

#include <algorithm>
#include <random>

namespace boxstream::measure {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

double quantile(std::vector<double> values, double p) {
  const auto at = static_cast<std::ptrdiff_t>(std::ceil(p * static_cast<double>(values.size())) - 1);
  const auto place = values.begin() + std::clamp<std::ptrdiff_t>(at, 0, std::ssize(values) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

Series summarize(const std::vector<double>& samples) {
  if (samples.empty()) return {};
  return {median(samples), *std::min_element(samples.begin(), samples.end()), samples.size()};
}

Estimate estimate(const std::vector<double>& values) {
  constexpr int samples = 2000;
  std::mt19937_64 random(1);
  std::vector<double> medians, sample(values.size());
  for (int i = 0; i < samples; ++i) {
    for (double& value : sample) value = values[random() % values.size()];
    medians.push_back(median(sample));
  }
  return {median(values), quantile(medians, 0.025), quantile(medians, 0.975), quantile(values, 0), NAN};
}

}  // namespace boxstream::measure
