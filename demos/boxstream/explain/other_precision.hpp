// SPDX-License-Identifier: MIT
#pragma once

#include "accuracy/elsewhere.hpp"

namespace boxstream::tool {

/// Runs what this program cannot in the one for worlds in double precision; null: it is not installed.
accuracy::Elsewhere other_precision();

}  // namespace boxstream::tool
