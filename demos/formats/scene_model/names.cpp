// SPDX-License-Identifier: MIT
#include "formats/scene_model/names.hpp"

namespace boxstream::scenes {

const std::vector<std::string>& broadphase_names() {
  static const std::vector<std::string> names{"boxstream", "hybrid", "dbvt", "dbvt-deferred", "sap", "simple"};
  return names;
}

Extra extra_pairs(const std::string& broadphase) {
  if (broadphase == "simple") return Extra::none;
  return broadphase == "boxstream" || broadphase == "hybrid" ? Extra::within_reach : Extra::any;
}

}  // namespace boxstream::scenes
