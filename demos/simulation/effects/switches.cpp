// SPDX-License-Identifier: MIT
#include "formats/scene_model/names.hpp"
#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/tunnelling.hpp"
#include "simulation/engine/world_recipe.hpp"

// What a scene switches on with one word.
namespace boxstream::effects {
namespace {

using scenes::WorldRecipe;

std::optional<Call> if_on(bool on, const char* pointer) {
  return on ? std::optional(Call{pointer, "true"}) : std::nullopt;
}

std::uint64_t count_cached(const SceneInstance& instance) {
  return count_points(instance, [](const btManifoldPoint& point, const auto&, const auto&) {
    return (point.m_contactPointFlags & BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED) != 0;
  });
}

std::uint64_t count_set_again(const SceneInstance& instance) {
  return static_cast<std::uint64_t>(std::count_if(instance.bodies.begin(), instance.bodies.end(), [](const auto& body) {
    return body->isInWorld() && !body->isActive();
  }));
}

std::optional<Call> calls_for_split_impulse(const Subject& subject) {
  if (!subject.scene.solver.split_impulse || !has_contacts(subject)) return std::nullopt;
  constexpr const char* reason = "contacts can come deep";
  const auto any = [](const scenes::Body&) { return true; };
  auto call = first_meeting(subject, is_dynamic, any, [](const scenes::Body&) { return reason; });
  return call ? call : Call{"/characters/0", reason};
}

void prepare_split_impulse(const Subject&, WorldRecipe& recipe) {
  recipe.solver.m_splitImpulse = 1;
}

void start_split_impulse(SceneInstance& instance) {
  const std::vector<double> half = half_thicknesses(instance.expanded.shapes);
  scenes::MovedApart::Bodies bodies;
  for (const scenes::Body& body : instance.expanded.bodies) bodies.thickness.push_back(2 * half[body.traits.shape]);
  const scenes::WorldSettings& world = instance.scene.world;
  bodies.have_weight = world.tumbling || world.gravity != scenes::Vec3{};
  instance.world.solver().set_moved_apart(scenes::MovedApart(std::move(bodies)));
}

}  // namespace

const Effect split_impulse{"split_impulse",
                           "deep contacts are separated without giving bodies speed",
                           "a second solve of contacts that are deep, of those that bounce, and of all without gravity",
                           calls_for_split_impulse,
                           {.prepare = prepare_split_impulse, .start = start_split_impulse},
                           {"contact points", count_rows<&scenes::SolverRows::pushed_apart>, Effect::Activity::of_run}};

const Effect other_solver{
    "other_solver",
    "contacts and joints are solved by another solver than Bullet's usual one",
    "that solver in its place; of matrices: one for each island",
    [](const Subject& subject) -> std::optional<Call> {
      const scenes::SolverKind kind = subject.scene.solver.kind;
      const bool solves = has_contacts(subject) || !subject.expanded.joints.empty();
      if (kind == scenes::SolverKind::sequential_impulses || kind == scenes::SolverKind::multibodies || !solves)
        return std::nullopt;
      return Call{"/solver/kind", scenes::solver_names().at(static_cast<std::size_t>(kind))};
    },
    {.prepare =
         [](const Subject& subject, WorldRecipe& recipe) {
           if (subject.scene.solver.kind == scenes::SolverKind::multibodies) return;
           recipe.solver_kind = subject.scene.solver.kind;
           // Islands are solved one by one, not joined to make larger matrices.
           if (scenes::solves_matrices(recipe.solver_kind)) recipe.solver.m_minimumSolverBatchSize = 1;
         }},
    {"rows", count_rows<&scenes::SolverRows::other>, Effect::Activity::of_run}};

const Effect friction_caching{
    "friction_caching",
    "directions of friction are taken over from the step before",
    "a mode of the solver",
    // Bullet keeps directions only where there are two that do not follow the velocity.
    [](const Subject& subject) {
      const scenes::Solver& solver = subject.scene.solver;
      const bool kept = solver.friction_directions == scenes::FrictionDirections::two_fixed;
      return if_on(solver.cache_friction && kept && friction.called_for(subject), "/solver/cache_friction");
    },
    {.prepare = [](const Subject&,
                   WorldRecipe& recipe) { recipe.solver.m_solverMode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING; }},
    {"contact points", count_cached}};

const Effect forced_boxes{"forced_boxes",
                          "boxes of sleeping bodies are set again in each step",
                          "setForceUpdateAllAabbs",
                          // Where nothing meets, no boxes are set at all.
                          [](const Subject& subject) {
                            return if_on(subject.scene.broadphase.force_boxes && contacts.called_for(subject),
                                         "/broadphase/force_boxes");
                          },
                          {.prepare = [](const Subject&, WorldRecipe& recipe) { recipe.force_boxes = true; }},
                          {"boxes", count_set_again}};

}  // namespace boxstream::effects
