// SPDX-License-Identifier: MIT
#include "broadphase_name.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bad_input.hpp"
#include "engine/broadphases.hpp"
#include "scene/broadphase_names.hpp"

namespace boxstream::tool {

void check_broadphase(const std::string& name) {
  const std::vector<std::string>& known = scenes::broadphase_names();
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  std::string names;
  for (const std::string& each : known) names += (names.empty() ? "" : ", ") + each;
  throw BadInput(fmt::format("unknown broad-phase \"{}\"; one of: {}", name, names));
}

}  // namespace boxstream::tool
