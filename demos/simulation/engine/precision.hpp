// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btScalar.h>

#include "formats/scene_model/settings.hpp"

namespace boxstream::scenes {

/// That of the Bullet in this program. There is one in each: both have the same names.
inline constexpr Precision precision_here = sizeof(btScalar) == sizeof(double) ? Precision::doubled : Precision::single;

}  // namespace boxstream::scenes
