// SPDX-License-Identifier: MIT
#include <LinearMath/btAabbUtil2.h>
#include <boxstream/detector.hpp>

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

/// Pairs that touch and are kept apart by what the scene says, of bodies that are in the world.
std::uint64_t count_refused(const SceneInstance& instance) {
  std::vector<Aabb64> boxes;
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    const btBroadphaseProxy* const proxy = instance.bodies[i]->getBroadphaseHandle();
    if (proxy == nullptr) continue;
    Aabb64& box = boxes.emplace_back();
    for (int d = 0; d < 3; ++d) box.min[d] = proxy->m_aabbMin[d], box.max[d] = proxy->m_aabbMax[d];
    bodies.push_back(i);
  }
  const auto refuses = [&](std::size_t i, std::size_t k) {
    const btBroadphaseProxy &a = *instance.bodies[i]->getBroadphaseHandle(),
                            &b = *instance.bodies[k]->getBroadphaseHandle();
    return (a.m_collisionFilterGroup & b.m_collisionFilterMask) == 0 ||
           (b.m_collisionFilterGroup & a.m_collisionFilterMask) == 0;
  };
  std::uint64_t count = 0;
  for (const Pair& pair : find_pairs(boxes)) {
    const Body &a = instance.expanded.bodies[bodies[pair.a]], &b = instance.expanded.bodies[bodies[pair.b]];
    count += (is_dynamic(a) || is_dynamic(b)) && refuses(bodies[pair.a], bodies[pair.b]);
  }
  return count;
}

std::uint64_t count_excluded(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for (const auto& [i, k] : instance.expanded.exclusions) {
    const btBroadphaseProxy* const a = instance.bodies[i]->getBroadphaseHandle();
    const btBroadphaseProxy* const b = instance.bodies[k]->getBroadphaseHandle();
    if (a == nullptr || b == nullptr) continue;
    count += TestAabbAgainstAabb2(a->m_aabbMin, a->m_aabbMax, b->m_aabbMin, b->m_aabbMax);
  }
  return count;
}

void start_exclusions(SceneInstance& instance) {
  for (const auto& [a, b] : instance.expanded.exclusions)
    instance.bodies[a]->setIgnoreCollisionCheck(instance.bodies[b].get(), true);
}

}  // namespace

const Effect collision_filters{"collision_filters",
                               "some kinds of bodies do not meet",
                               "group and mask of those bodies, in place of Bullet's",
                               calls_for_filters,
                               {},
                               {"touching boxes kept apart", count_refused}};

const Effect exclusions{"apart",
                        "some pairs of bodies pass through each other",
                        "setIgnoreCollisionCheck of those",
                        calls_for_exclusions,
                        {.start = start_exclusions},
                        {"touching boxes kept apart", count_excluded}};

}  // namespace boxstream::effects
