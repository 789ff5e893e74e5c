// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "pictures/viewer/page.hpp"

namespace boxstream::view {

/// All of a world but its frames, as JSON, for the viewer: title, about, label, dt, unit, the forms and parts of the
/// model, which objects of the world these are, their names and joints, the step and crowd of each frame. Numbers and
/// times of every step are those of the whole world.
std::string describe(const PageWorld& world, const std::string& versions);

}  // namespace boxstream::view
