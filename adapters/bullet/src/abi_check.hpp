// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/bullet/precision.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// What the libraries of this process make of a box of ours, so that no setting of Bullet's can mislead it.
bool libraries_have_our_precision();

/// Aborts, with a line that says so, if the Bullet libraries of this process were built with the other precision.
/// The linker does not notice, because most of Bullet's symbols do not name their scalar type.
void require_matching_precision();

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
