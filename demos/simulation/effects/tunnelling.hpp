// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "simulation/effects/effect.hpp"

namespace boxstream::effects {

/// Half the thinnest extent of each shape, in metres: 0 of a surface, infinite of a half-space. That of a hull takes a
/// millisecond.
std::vector<double> half_thicknesses(const std::vector<scenes::Shape>& shapes);

/// Of half its thickness, or of that and half an obstacle's, how much a body may move in a substep. A half: what meets
/// an obstacle with a tip keeps nearly all its speed, and goes as far again before more of it is stopped. Less for
/// cones and hulls, which have no margin; all for a ball, which has no tips.
double safe_share(const scenes::Shape& shape);

/// For each body, how far in metres it may move in a substep without passing through something that it can touch: its
/// share of half its own thickness, for each of two moving bodies may use as much; where all that it can touch is
/// fixed, of that and half the thickness of the thinnest obstacle. A sensor stops nothing: all of both. Infinite if it
/// touches nothing or is not dynamic, and where "ccd": false of body or world rules sweeping out.
std::vector<double> safe_motions(const Subject& subject);

/// Whether there is anything that a body can touch, or a sensor that can notice it.
bool can_hit(const Subject& subject, std::size_t body);

}  // namespace boxstream::effects
