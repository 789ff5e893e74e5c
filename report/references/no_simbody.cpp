// SPDX-License-Identifier: MIT
#include "simbody.hpp"

namespace boxstream::report {

bool simbody_is_built() {
  return false;
}

accuracy::Track simbody_track(const scenes::Scene&, std::uint64_t) {
  return {};
}

}  // namespace boxstream::report
