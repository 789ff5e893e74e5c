// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

namespace boxstream::tool {

/// Nanoseconds a body and step, and the least and the greatest of what was measured.
struct MeasuredPrice {
  double ns, low, high;
};

/// What effects cost where a scene calls for them, by name.
using Prices = std::map<std::string, MeasuredPrice>;

/// As measured last, when demos/simulation/effects/prices.json was written; it is compiled in.
Prices measured_prices();

}  // namespace boxstream::tool
