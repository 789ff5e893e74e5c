// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_shape<HeightfieldShape>(subject, "a body of this shape");
}

}  // namespace

const Effect heightfields{"heightfields", "ground made of heights", "btHeightfieldTerrainShape, when a body has it",
                          called_for};

}  // namespace boxstream::effects
