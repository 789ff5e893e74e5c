// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/viewer/snapshot.hpp"

namespace boxstream::view {

/// The box around the boxes of what moves, without the hundredth that reaches furthest to each side; around everything
/// that has an end if nothing moves. What has gone astray would make all else small in a picture.
Snapshot::Box crowd_of(const Snapshot& snapshot);

/// From where a page looks at the crowd when it opens.
inline constexpr Point first_direction{0.62F, 0.5F, 0.85F};

/// Where its camera is then. How far exactly depends on the window.
Point first_eye(const Snapshot::Box& crowd);

}  // namespace boxstream::view
