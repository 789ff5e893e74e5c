// SPDX-License-Identifier: MIT
#include "papers/experiments/structures.hpp"

namespace boxstream::papers {

// Each is in the file of its name.
std::vector<StructureEntry> engine_structures();
std::vector<StructureEntry> scan_structures();
std::vector<StructureEntry> kd_structures();
std::vector<StructureEntry> dynamic_structures();
std::vector<StructureEntry> octree_structures();
std::vector<StructureEntry> volume_structures();

Span<const StructureEntry> structures() {
  static const std::vector<StructureEntry> all = [] {
    std::vector<StructureEntry> joined;
    for (const auto list :
         {engine_structures, scan_structures, kd_structures, dynamic_structures, octree_structures, volume_structures})
      for (const StructureEntry& entry : list()) joined.push_back(entry);
    return joined;
  }();
  return all;
}

}  // namespace boxstream::papers
