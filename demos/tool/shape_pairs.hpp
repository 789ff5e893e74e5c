// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "commands.hpp"

namespace boxstream::tool {

/// The command pairs for a text of shapes; `name` stands for it in messages. Throws BadInput if this program was built
/// without a narrow phase.
int shape_pairs(const std::string& text, const std::string& name, const PairsOptions& options);

}  // namespace boxstream::tool
