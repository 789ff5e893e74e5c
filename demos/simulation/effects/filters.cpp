// SPDX-License-Identifier: MIT
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"

// Bodies that do not meet.
namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_filters(const Subject& subject) {
  return first_body(subject, [](const Body& body) -> std::string {
    return body.traits.group ? "a group of its own" : body.traits.mask ? "a mask of its own" : "";
  });
}

std::optional<Call> calls_for_exclusions(const Subject& subject) {
  const char* const reason = "two bodies that pass through each other";
  if (!subject.scene.exclusions.empty()) return first_of(subject.scene.exclusions, "/apart", reason);
  if (subject.expanded.exclusions.empty()) return std::nullopt;
  return Call{scenes::pointer_of_body(subject.expanded, subject.expanded.exclusions.front()[0]), reason};
}

void start_exclusions(SceneInstance& instance) {
  for (const auto& [a, b] : instance.expanded.exclusions)
    instance.bodies[a]->setIgnoreCollisionCheck(instance.bodies[b].get(), true);
}

}  // namespace

const Effect collision_filters{"collision_filters", "some kinds of bodies do not meet",
                               "group and mask of those bodies, in place of Bullet's", calls_for_filters};

const Effect exclusions{"apart",
                        "some pairs of bodies pass through each other",
                        "setIgnoreCollisionCheck of those",
                        calls_for_exclusions,
                        {.start = start_exclusions}};

}  // namespace boxstream::effects
