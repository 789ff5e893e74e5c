// SPDX-License-Identifier: MIT
#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_contacts(const Subject& subject) {
  const Scene& scene = subject.scene;
  if (!scene.soft_bodies.empty()) return Call{"/soft_bodies/0", "a soft body"};
  if (!scene.characters.empty()) return Call{"/characters/0", "a character"};
  const auto any = [](const Body&) { return true; };
  return first_meeting(subject, is_dynamic, any, [](const Body&) { return "a dynamic body that can meet another"; });
}

void prepare_contacts(const Subject& subject, WorldRecipe& recipe) {
  const Solver& solver = subject.scene.solver;
  recipe.collide = true;
  if (solver.warmstart) recipe.solver.m_solverMode |= SOLVER_USE_WARMSTARTING;
  recipe.solver.m_erp2 = real(solver.contact_erp);
  recipe.solver.m_linearSlop = real(solver.slop);
}

std::uint64_t count_contacts(const SceneInstance& instance) {
  const auto any = [](const auto&...) { return true; };
  std::uint64_t count = count_points(instance, any) + count_soft_points(instance, any);
  for (const auto& soft : instance.soft_bodies) count += static_cast<std::uint64_t>(soft->m_scontacts.size());
  for (const Walker& walker : instance.walkers) count += walker.touched(instance.world.dispatcher()).size();
  return count;
}

}  // namespace

const Effect contacts{
    "contacts",         "bodies touch and push each other", "updateAabbs, pairs, narrow phase and contact rows",
    calls_for_contacts, {.prepare = prepare_contacts},      {"contact points", count_contacts}};

}  // namespace boxstream::effects
