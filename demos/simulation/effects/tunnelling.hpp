// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "simulation/effects/effect.hpp"

namespace boxstream::effects {

/// Half the thinnest extent of each shape, in metres: 0 of a surface, infinite of a half-space. That of a hull takes a
/// millisecond.
std::vector<double> half_thicknesses(const std::vector<scenes::Shape>& shapes);

/// For each body, how far in metres it may move in a substep without jumping over something that it can touch: half its
/// own thickness, for each of two moving bodies may use as much, and where all that it can touch is fixed, half the
/// thickness of the thinnest of that besides. A sensor is as good as a fixed body. Infinite if it touches nothing or is
/// not dynamic, and where "ccd": false of body or world rules sweeping out.
std::vector<double> safe_motions(const Subject& subject);

/// Whether there is anything that a body can touch, or be noticed by.
bool can_hit(const Subject& subject, std::size_t body);

}  // namespace boxstream::effects
