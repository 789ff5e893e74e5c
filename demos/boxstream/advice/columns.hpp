// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "boxstream/advice/hard_families.hpp"
#include "simulation/effects/effect.hpp"

namespace boxstream::tool {

/// Columns of a scene as it starts: for each dynamic body that carries others, the bodies on it or hanging from it. Its
/// load is that of a uniform column with the same weight on its first body.
struct Columns {
  std::vector<Column> list;
  double size = 0;     ///< metres: how far a body is from the one that bears it, on the mean
  bool awake = false;  ///< one of them may not fall asleep, so none does that bears it or that it bears
};

/// Bodies that stand on each other: their boxes touch, and one is wholly above the other's centre. `up` is a unit
/// vector. Masses are those of the bodies, 0 of what is not dynamic. Throws SceneError for a shape that cannot be
/// built.
Columns stacks_of(const effects::Subject& subject, const std::vector<double>& masses, const scenes::Vec3& up);

/// A body that stands on one other alone, with all that stands on it in turn.
struct Lean {
  std::size_t body;    ///< the one that bears them
  std::size_t bodies;  ///< with that one
  double share;        ///< how far their centre of mass is to the side, of what lets them fall
};

/// Where stacks lean or overhang most, body by body. Arguments are those of `stacks_of`.
std::vector<Lean> leans_of(const effects::Subject& subject, const std::vector<double>& masses, const scenes::Vec3& up);

/// Bodies that are connected by joints, directly or through others, to something that cannot move.
Columns chains_of(const effects::Subject& subject, const std::vector<double>& masses);

}  // namespace boxstream::tool
