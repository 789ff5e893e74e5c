// SPDX-License-Identifier: MIT
#include "formats/scene_model/broadphase_names.hpp"

namespace boxstream::scenes {

const std::vector<std::string>& broadphase_names() {
  static const std::vector<std::string> names{"boxstream", "dbvt", "dbvt-deferred", "sap", "simple"};
  return names;
}

}  // namespace boxstream::scenes
