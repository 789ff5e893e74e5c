// SPDX-License-Identifier: MIT
#include "kinds.hpp"

#include "kinds/all.hpp"

namespace boxstream::report {

const std::vector<NamedKind>& kinds() {
  static const std::vector<NamedKind> all{
      {"narrow", narrow_kind},
      {"neutrality", neutrality_kind},
      {"predictability", predictability_kind},
      {"scene", scene_kind},
  };
  return all;
}

}  // namespace boxstream::report
