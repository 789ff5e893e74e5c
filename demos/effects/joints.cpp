// SPDX-License-Identifier: MIT
#include "engine/joints.hpp"
#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"
#include "engine/convert.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_joint(subject, [](const Joint&) { return "a joint"; });
}

void prepare(const Subject& subject, WorldRecipe& recipe) {
  recipe.solver.m_erp = real(subject.scene.solver.erp);
}

void start(Stage& stage) {
  for (const Joint& joint : stage.expanded.joints) {
    btRigidBody* const b = joint.b ? stage.bodies[*joint.b].get() : nullptr;
    stage.joints.push_back(make_joint(joint.value, *stage.bodies[joint.a], b, stage.substep));
    stage.world.world().addConstraint(stage.joints.back().get(), !joint.collide);
  }
}

}  // namespace

const Effect joints{"joints",
                    "bodies are held together",
                    "a constraint for each, with rows in each iteration",
                    called_for,
                    prepare,
                    nullptr,
                    start};

}  // namespace boxstream::effects
