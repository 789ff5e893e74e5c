// SPDX-License-Identifier: MIT
#include "simulation/engine/multibodies.hpp"

#include <algorithm>
#include <stdexcept>

#include "formats/scene_model/scene_error.hpp"
#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/world_recipe.hpp"

// Chains and robots by the coordinates of their joints.
namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_multibodies(const Subject& subject) {
  if (subject.trees.trees.empty()) return std::nullopt;
  return Call{"/solver/kind", "multibodies"};
}

void prepare_multibodies(const Subject& subject, WorldRecipe& recipe) {
  if (subject.trees.trees.empty()) return;
  recipe.solver_kind = SolverKind::multibodies;
  if (!subject.scene.solver.warmstart) return;
  recipe.solver.m_solverMode |= SOLVER_USE_ARTICULATED_WARMSTARTING;
  recipe.solver.m_articulatedWarmstartingFactor = 1;
}

void start_multibodies(SceneInstance& instance) {
  const JointTrees& trees = instance.subject.trees;
  if (trees.trees.empty()) return;
  std::vector<std::optional<LinkJoint>> joints;
  for (const Joint& joint : instance.expanded.joints) joints.push_back(link_joint(joint));
  const auto& bodies = instance.expanded.bodies;
  const bool damped = std::any_of(bodies.begin(), bodies.end(), [](const Body& body) {
    return body.traits.linear_damping > 0 || body.traits.angular_damping > 0;
  });
  try {
    instance.multibodies =
        std::make_unique<Multibodies>(*instance.world.multibody_world(), trees, joints, instance.bodies, damped, true);
  } catch (const std::invalid_argument& error) {
    throw SceneError(instance.scene.file + ": /solver/kind: " + error.what());
  }
  instance.before_substep(multibodies, [&instance](double dt) { instance.multibodies->before_step(dt); });
  instance.before_solver(multibodies, [&instance](double dt) {
    instance.multibodies->before_solver(dt);
    // The account of energy looks at what is acted on: joints act on all links.
    const auto& acting_on = instance.world.hooks.acting_on;
    if (!acting_on) return;
    for (std::size_t i = 0; i < instance.bodies.size(); ++i)
      if (instance.subject.trees.has_body(i)) acting_on(*instance.bodies[i]);
  });
  instance.before_motion(multibodies, [&instance](double) { instance.multibodies->before_motion(); });
  instance.after_motion(multibodies, [&instance](double) {
    Multibodies& all = *instance.multibodies;
    const double worked = all.work_of_motors();
    const std::uint64_t moved = all.moved();
    all.after_motion();
    instance.world.solver().add_work_of_motors(all.work_of_motors() - worked);
    instance.world.solver().add_links(all.moved() - moved);
  });
}

}  // namespace

const Effect multibodies{"multibodies",
                         "chains and robots are solved by the coordinates of their joints, which cannot come apart",
                         "a btMultiBody for each tree of joints; its poses and velocities are copied each substep",
                         calls_for_multibodies,
                         {.prepare = prepare_multibodies, .start = start_multibodies},
                         {"links", count_rows<&SolverRows::links>, Effect::Activity::of_run}};

}  // namespace boxstream::effects
