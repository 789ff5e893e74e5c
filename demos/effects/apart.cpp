// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_of(subject.scene.apart, "/apart", "two bodies that pass through each other");
}

void start(Stage& stage) {
  for (const auto& [a, b] : stage.scene.apart) stage.bodies[a]->setIgnoreCollisionCheck(stage.bodies[b].get(), true);
}

}  // namespace

const Effect apart{"apart",
                   "some pairs of bodies pass through each other",
                   "setIgnoreCollisionCheck of those",
                   called_for,
                   nullptr,
                   nullptr,
                   start};

}  // namespace boxstream::effects
