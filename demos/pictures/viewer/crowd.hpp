// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/viewer/snapshot.hpp"

namespace boxstream::view {

/// The bounds of what moves, without the outermost 1 % on each side; of everything that is bounded if nothing moves.
/// A few bodies that flew off would make all others small in a picture.
Snapshot::Box crowd_of(const Snapshot& snapshot);

/// From where a page looks at the crowd when it opens.
inline constexpr Point first_direction{0.62F, 0.5F, 0.85F};

/// Where its camera is then. How far exactly depends on the window.
Point first_eye(const Snapshot::Box& crowd);

}  // namespace boxstream::view
