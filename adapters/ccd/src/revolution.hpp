// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

#include "shape_pair.hpp"

namespace boxstream::ccd {

/// If both cores are solids of revolution about parallel axes, A - B is one too. The candidates for the minimum
/// translation are then the axis and these two normals: of the sides of the two profiles, in the half-plane through the
/// origin. Empty otherwise, and where the matrices are too far from rotations.
std::optional<std::array<Vec, 2>> profile_normals(const ShapePair& pair);

}  // namespace boxstream::ccd
