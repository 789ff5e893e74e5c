// SPDX-License-Identifier: MIT
#include <algorithm>
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
  const auto& pairs = subject.expanded.exclusions;
  const auto found =
      std::find_if(pairs.begin(), pairs.end(), [&](const auto& p) { return subject.collidable.accept(p[0], p[1]); });
  if (found == pairs.end()) return std::nullopt;
  const auto index = static_cast<std::size_t>(found - pairs.begin());
  return Call{index < subject.scene.exclusions.size() ? fmt::format("/exclusions/{}", index)
                                                      : scenes::pointer_of_body(subject.expanded, (*found)[0]),
              "two bodies that pass through each other"};
}

/// Where a body is now. The broad-phase has no boxes that are kept up to date where no bodies meet.
Aabb64 box_of(const btRigidBody& body) {
  btVector3 low, high;
  body.getAabb(low, high);
  return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

/// Pairs that touch and are kept apart by what the scene says, of bodies that are in the world.
std::uint64_t count_refused(const SceneInstance& instance) {
  std::vector<Aabb64> boxes;
  std::vector<std::size_t> bodies;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    if (!instance.bodies[i]->isInWorld()) continue;
    boxes.push_back(box_of(*instance.bodies[i]));
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
    const btRigidBody &a = *instance.bodies[i], &b = *instance.bodies[k];
    count += a.isInWorld() && b.isInWorld() && overlaps(box_of(a), box_of(b));
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

const Effect exclusions{"exclusions",
                        "some pairs of bodies pass through each other",
                        "setIgnoreCollisionCheck of those",
                        calls_for_exclusions,
                        {.start = start_exclusions},
                        {"touching boxes kept apart", count_excluded}};

}  // namespace boxstream::effects
