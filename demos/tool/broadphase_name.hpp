// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::tool {

/// Throws BadInput, naming those there are, if `name` is no broad-phase for Bullet and none of `more`.
void check_broadphase(const std::string& name, const std::vector<std::string>& more = {});

}  // namespace boxstream::tool
