// SPDX-License-Identifier: MIT
#include "formats/scene_model/broadphase_names.hpp"

namespace boxstream::scenes {

const std::vector<std::string>& broadphase_names() {
  static const std::vector<std::string> names{"boxstream", "hybrid", "dbvt", "dbvt-deferred", "sap", "simple"};
  return names;
}

bool is_exact(const std::string& broadphase) {
  return broadphase == "boxstream" || broadphase == "hybrid" || broadphase == "simple";
}

}  // namespace boxstream::scenes
