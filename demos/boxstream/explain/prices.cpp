// SPDX-License-Identifier: MIT
#include "boxstream/explain/prices.hpp"

#include <nlohmann/json.hpp>

namespace boxstream::tool {

extern const char* const prices_json;  // made from demos/simulation/effects/prices.json by CMake

Prices measured_prices() {
  const nlohmann::json document = nlohmann::json::parse(prices_json);
  Prices prices;
  for (const auto& [name, price] : document.at("effects").items())
    prices[name] = {price.at("ns_per_body_step"), price.at("interval_ns").at(0), price.at("interval_ns").at(1)};
  return prices;
}

}  // namespace boxstream::tool
