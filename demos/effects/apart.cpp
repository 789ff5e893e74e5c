// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  const char* const reason = "two bodies that pass through each other";
  if (!subject.scene.apart.empty()) return first_of(subject.scene.apart, "/apart", reason);
  if (subject.expanded.apart.empty()) return std::nullopt;
  return Call{scenes::pointer_of_body(subject.expanded, subject.expanded.apart.front()[0]), reason};
}

void start(Stage& stage) {
  for (const auto& [a, b] : stage.expanded.apart) stage.bodies[a]->setIgnoreCollisionCheck(stage.bodies[b].get(), true);
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
