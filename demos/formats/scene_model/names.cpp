// SPDX-License-Identifier: MIT
#include "formats/scene_model/names.hpp"

#include "formats/scene_model/checks.hpp"

namespace boxstream::scenes {

const std::vector<std::string>& broadphase_names() {
  static const std::vector<std::string> names{"boxstream", "hybrid", "dbvt", "dbvt-deferred", "sap", "simple"};
  return names;
}

Extra extra_pairs(const std::string& broadphase) {
  if (broadphase == "simple") return Extra::none;
  return broadphase == "boxstream" || broadphase == "hybrid" ? Extra::within_reach : Extra::any;
}

const std::vector<std::string>& metric_names() {
  static const std::vector<std::string> names{"missed_pairs", "finite",   "outside",   "max_penetration", "energy",
                                              "energy_drift", "momentum", "max_speed", "residual",        "sleeping",
                                              "pairs",        "lowest",   "highest"};
  return names;
}

const std::vector<std::string>& op_names() {
  static const std::vector<std::string> names{"<", "<=", "==", ">=", ">"};
  return names;
}

const char* name_of(Check::Metric metric) {
  return metric_names()[static_cast<std::size_t>(metric)].c_str();
}

const char* name_of(Check::Op op) {
  return op_names()[static_cast<std::size_t>(op)].c_str();
}

}  // namespace boxstream::scenes
