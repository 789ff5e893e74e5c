// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::scenes {

/// What scenes and the command line may ask for: "boxstream", "hybrid", "dbvt", "dbvt-deferred", "sap", "simple".
const std::vector<std::string>& broadphase_names();

/// What pairs a broad-phase may hold besides those whose boxes touch.
enum class Extra {
  none,
  within_reach,  ///< of contacts: see Options::exact_boxes of the Bullet adapter
  any,
};
Extra extra_pairs(const std::string& broadphase);

}  // namespace boxstream::scenes
