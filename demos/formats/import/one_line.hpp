// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::imports {

/// Throws scenes::SceneError "FILE: reason", on one line whatever is in them: control characters become \xNN.
[[noreturn]] void fail(const std::string& file, const std::string& reason);

}  // namespace boxstream::imports
