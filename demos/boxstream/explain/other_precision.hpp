// SPDX-License-Identifier: MIT
#pragma once

#include "accuracy/elsewhere.hpp"

namespace boxstream::tool {

/// Has the program of worlds in double precision do what this one cannot; null: it is not installed.
accuracy::Elsewhere other_precision();

}  // namespace boxstream::tool
