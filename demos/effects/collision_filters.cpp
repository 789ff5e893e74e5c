// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_body(subject, [](const Body& body) -> std::string {
    return body.traits.group ? "a group of its own" : body.traits.mask ? "a mask of its own" : "";
  });
}

}  // namespace

const Effect collision_filters{"collision_filters", "some kinds of bodies do not meet",
                               "group and mask of those bodies, in place of Bullet's", called_for};

}  // namespace boxstream::effects
