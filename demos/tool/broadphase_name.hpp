// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::tool {

/// Throws BadInput, naming those there are, if there is no broad-phase of that name.
void check_broadphase(const std::string& name);

}  // namespace boxstream::tool
