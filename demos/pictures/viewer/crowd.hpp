// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/viewer/snapshot.hpp"

namespace boxstream::view {

/// The box around the boxes of what moves, without the hundredth that reaches furthest to each side; around everything
/// that has an end if nothing moves. What has gone astray would make all else small in a picture.
Snapshot::Box crowd_of(const Snapshot& snapshot);

}  // namespace boxstream::view
