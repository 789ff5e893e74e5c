// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "base/keys.hpp"

namespace boxstream::detail {

/// Copies boxes to `out`, the high ends of valid ones raised by `tolerance` (base/tolerance.hpp). In the default
/// floating-point environment.
void raise_ends(Span<const Aabb> boxes, double tolerance, Faces faces, Aabb* out);

}  // namespace boxstream::detail
