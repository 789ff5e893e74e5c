// SPDX-License-Identifier: MIT
#include "witnesses/witness.hpp"

namespace boxstream::witnesses {

bool simbody_is_built() {
  return false;
}

std::vector<Frame> run_simbody(const scenes::Scene&, std::size_t, double) {
  return {};
}

}  // namespace boxstream::witnesses
