// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::scenes {

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

}  // namespace boxstream::scenes
