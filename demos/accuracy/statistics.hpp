// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace boxstream::accuracy {

/// Of measurements that were repeated. The interval has the median in 95 of 100 series like this one (bootstrap of 2000
/// samples with a fixed seed).
struct Estimate {
  double median = 0;
  double low = 0;
  double high = 0;
  double least = 0;           ///< of all values
  double instructions = NAN;  ///< of one measurement, where they were counted
};

/// Of at least one value.
Estimate estimate(const std::vector<double>& values);

/// The value that a share `p` (0 to 1) of the others does not exceed; of at least one value.
double quantile(std::vector<double> values, double p);

/// Cost and error of one candidate; both are better when smaller.
struct Offer {
  double cost = 0;
  double error = 0;
};

/// Indices of the offers that no other beats in one of the two without losing in the other, by increasing cost. Offers
/// with a NaN are never among them.
std::vector<std::size_t> front(const std::vector<Offer>& offers);

}  // namespace boxstream::accuracy
