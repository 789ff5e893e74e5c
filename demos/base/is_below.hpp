// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::files {

/// Is the place that `name` leads to, without symbolic links, in the folder or below it? It need not be there yet.
bool is_below(const std::string& folder, const std::string& name);

}  // namespace boxstream::files
