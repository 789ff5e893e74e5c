// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::scenes {

/// What scenes and the command line may ask for: "boxstream", "dbvt", "dbvt-deferred", "sap", "simple".
const std::vector<std::string>& broadphase_names();

}  // namespace boxstream::scenes
