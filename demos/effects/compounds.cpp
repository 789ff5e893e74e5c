// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_shape<CompoundShape>(subject, "a body of this shape");
}

}  // namespace

const Effect compounds{"compounds", "bodies made of several shapes", "btCompoundShape and its tree, when a body has it",
                       called_for};

}  // namespace boxstream::effects
