// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_shape<PlaneShape>(subject, "a body of this shape");
}

}  // namespace

const Effect planes{"planes", "endless ground", "btStaticPlaneShape, and pairs with everything, when a body has it",
                    called_for};

}  // namespace boxstream::effects
