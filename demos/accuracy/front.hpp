// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

namespace boxstream::accuracy {

/// Cost and error of one candidate; smaller is better for both.
struct Offer {
  double cost = 0;
  double error = 0;
};

/// Indices of the Pareto-optimal offers, by increasing cost. Offers with a NaN are never among them.
std::vector<std::size_t> front(const std::vector<Offer>& offers);

}  // namespace boxstream::accuracy
