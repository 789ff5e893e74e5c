// SPDX-License-Identifier: MIT
#include "witnesses/witness.hpp"

namespace boxstream::witnesses {

bool ode_is_built() {
  return false;
}

std::vector<Frame> run_ode(const scenes::Scene&, std::size_t, const OdeSettings&) {
  return {};
}

}  // namespace boxstream::witnesses
