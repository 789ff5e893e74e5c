// SPDX-License-Identifier: MIT
#include "references/simbody.hpp"

namespace boxstream::report {

bool simbody_is_built() {
  return false;
}

accuracy::Trajectory simbody_trajectory(const scenes::Scene&, std::uint64_t) {
  return {};
}

}  // namespace boxstream::report
