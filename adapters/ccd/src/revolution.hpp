// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "couple.hpp"

namespace boxstream::ccd {

/// If both cores are bodies of revolution about parallel axes, A - B is one too. Its ends are square to the axis; its
/// side is square to one of these where it is nearest to the origin: that is in the half-plane through the origin, in
/// which the side is a row of edges of the two profiles. Empty otherwise, and where the matrices are too far from
/// rotations to say so.
std::optional<std::array<Vec, 2>> profile_normals(const Couple& couple);

}  // namespace boxstream::ccd
