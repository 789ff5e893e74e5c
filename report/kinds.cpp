// SPDX-License-Identifier: MIT
#include "kinds.hpp"

#include "kinds/all.hpp"

namespace boxstream::report {

const std::vector<NamedKind>& kinds() {
  static const std::vector<NamedKind> all{
      {"box-kinds", box_kinds_kind},
      {"cells", cells_kind},
      {"far-boxes", far_boxes_kind},
      {"fcl-boxes", fcl_boxes_kind},
      {"fcl-managers", fcl_managers_kind},
      {"frames", frames_kind},
      {"narrow", narrow_kind},
      {"neutrality", neutrality_kind},
      {"outputs", outputs_kind},
      {"predictability", predictability_kind},
      {"scene", scene_kind},
  };
  return all;
}

}  // namespace boxstream::report
