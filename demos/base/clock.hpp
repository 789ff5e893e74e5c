// SPDX-License-Identifier: MIT
#pragma once

#include "measure/clock.hpp"

namespace boxstream::scenes {

using measure::Clock;
using measure::milliseconds;
using measure::now;

}  // namespace boxstream::scenes
