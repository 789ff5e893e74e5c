// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btScalar.h>

#include "precision.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// False for values that Bullet's distance settings can only have when a float is read as a double, or the reverse:
/// denormal, negative, absurdly large or not a number.
bool plausible_distance(btScalar value);

/// Aborts, with a line that says so, if the Bullet libraries of this process were built with the other precision.
/// The linker does not notice, because most of Bullet's symbols do not name their scalar type.
void require_matching_precision();

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
