// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::tool {

/// Of the narrow phase.
struct NarrowOptions {
  double tolerance = 1e-6;
  int iterations = 500;
  std::string solver = "auto";  // or "gjk", "mpr"
};

/// The command pairs for a text of shapes; `name` stands for it in messages. Throws BadInput if this program was built
/// without a narrow phase.
int shape_pairs(const std::string& text, const std::string& name, bool list, const NarrowOptions& options);

}  // namespace boxstream::tool
