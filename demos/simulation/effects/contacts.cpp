// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

/// What Bullet's filter uses.
struct Groups {
  std::uint32_t group, mask;
  bool operator==(const Groups&) const = default;
};

Groups groups_of(const BodyTraits& traits) {
  const bool dynamic = traits.type == BodyType::dynamic;
  const auto usual_group =
      static_cast<std::uint32_t>(dynamic ? btBroadphaseProxy::DefaultFilter : btBroadphaseProxy::StaticFilter);
  const auto usual_mask = static_cast<std::uint32_t>(
      dynamic ? btBroadphaseProxy::AllFilter : btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::StaticFilter);
  if (!traits.group && !traits.mask) return {usual_group, usual_mask};
  return {traits.group.value_or(btBroadphaseProxy::DefaultFilter), traits.mask.value_or(0x7fffffff)};
}

bool meet(const Groups& a, const Groups& b) {
  return (a.group & b.mask) != 0 && (b.group & a.mask) != 0;
}

std::optional<Call> called_for(const Subject& subject) {
  const Scene& scene = subject.scene;
  if (!scene.soft_bodies.empty()) return Call{"/soft_bodies/0", "a soft body"};
  if (!scene.characters.empty()) return Call{"/characters/0", "a character"};
  // Few kinds of groups, many bodies: each kind once, and whether there is a second body of it.
  std::vector<std::pair<Groups, int>> kinds;
  for (const Body& body : subject.expanded.bodies) {
    const Groups groups = groups_of(body.traits);
    const auto known = std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.first == groups; });
    if (known == kinds.end())
      kinds.push_back({groups, 1});
    else
      ++known->second;
  }
  return first_body(subject, [&](const Body& body) -> std::string {
    if (!is_dynamic(body)) return {};
    const Groups mine = groups_of(body.traits);
    for (const auto& [other, count] : kinds)
      if (meet(mine, other) && (count > 1 || other != mine)) return "a dynamic body that can meet another";
    return {};
  });
}

void prepare(const Subject& subject, WorldRecipe& recipe) {
  const Solver& solver = subject.scene.solver;
  recipe.collide = true;
  if (solver.warmstart) recipe.solver.m_solverMode |= SOLVER_USE_WARMSTARTING;
  recipe.solver.m_erp2 = real(solver.contact_erp);
  recipe.solver.m_linearSlop = real(solver.slop);
}

}  // namespace

const Effect contacts{"contacts",
                      "bodies touch and push each other",
                      "updateAabbs, pairs, narrow phase and contact rows",
                      called_for,
                      {.prepare = prepare}};

}  // namespace boxstream::effects
