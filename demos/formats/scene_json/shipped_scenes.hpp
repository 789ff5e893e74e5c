// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace boxstream::scenes {

/// Where a file or a folder of demos/scenes is, for programs that are run from the build tree:
/// "hard/mass_ratio_400.json". Without a path, that folder itself.
std::string shipped(std::string_view path = {});

}  // namespace boxstream::scenes
