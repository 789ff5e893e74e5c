// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>

namespace boxstream::tool {

/// What effects cost where a scene calls for them: nanoseconds a body and step, by name.
using Prices = std::map<std::string, double>;

/// As measured last, when demos/simulation/effects/prices.json was written; it is compiled in.
Prices measured_prices();

}  // namespace boxstream::tool
