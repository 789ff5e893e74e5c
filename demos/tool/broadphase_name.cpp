// SPDX-License-Identifier: MIT
#include "broadphase_name.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bad_input.hpp"
#include "engine/broadphases.hpp"
#include "near_match.hpp"
#include "scene/broadphase_names.hpp"

namespace boxstream::tool {

void check_broadphase(const std::string& name, const std::vector<std::string>& more) {
  std::vector<std::string> known = more;
  known.insert(known.end(), scenes::broadphase_names().begin(), scenes::broadphase_names().end());
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  std::string names;
  for (const std::string& each : known) names += (names.empty() ? "" : ", ") + each;
  throw BadInput(fmt::format("unknown broad-phase \"{}\"{}; one of: {}", name, did_you_mean(name, known), names));
}

}  // namespace boxstream::tool
