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

/// As scenes write them, in the order of the enumeration SolverKind.
inline const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names{"sequential_impulses",    "nncg",       "dantzig", "lemke",
                                              "projected_gauss_seidel", "multibodies"};
  return names;
}

/// The same of Bounces.
inline const std::vector<std::string>& bounces_names() {
  static const std::vector<std::string> names{"in_solver", "on_contact"};
  return names;
}

/// The same of Precision.
inline const std::vector<std::string>& precision_names() {
  static const std::vector<std::string> names{"single", "double"};
  return names;
}

/// As scenes write them, in the order of the enumeration FrictionDirections.
inline const std::vector<std::string>& friction_directions_names() {
  static const std::vector<std::string> names{"one", "two", "two_fixed"};
  return names;
}

}  // namespace boxstream::scenes
