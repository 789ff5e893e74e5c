// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::scenes {

/// What scenes and the command line may ask for: "boxstream", "hybrid", "dbvt", "dbvt-deferred", "sap", "simple".
const std::vector<std::string>& broadphase_names();

/// Whether it holds exactly the pairs whose boxes touch; others may hold more.
bool is_exact(const std::string& broadphase);

}  // namespace boxstream::scenes
