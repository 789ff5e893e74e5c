// SPDX-License-Identifier: MIT
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

struct Make {
  btSoftBodyWorldInfo& info;

  std::unique_ptr<btSoftBody> operator()(const ClothSoft& cloth) const {
    return std::unique_ptr<btSoftBody>(btSoftBodyHelpers::CreatePatch(
        info, vector(cloth.corners[0]), vector(cloth.corners[1]), vector(cloth.corners[2]), vector(cloth.corners[3]),
        cloth.resolution[0], cloth.resolution[1], cloth.pinned, true));
  }
  std::unique_ptr<btSoftBody> operator()(const BallSoft& ball) const {
    const btScalar r = real(ball.radius);
    auto body = std::unique_ptr<btSoftBody>(
        btSoftBodyHelpers::CreateEllipsoid(info, vector(ball.centre), btVector3(r, r, r), ball.resolution));
    body->m_cfg.kPR = real(ball.pressure);
    return body;
  }
};

std::optional<Call> calls_for_soft_bodies(const Subject& subject) {
  return first_of(subject.scene.soft_bodies, "/soft_bodies", "a soft body");
}

void prepare_soft_bodies(const Subject&, WorldRecipe& recipe) {
  recipe.soft = true;
  recipe.collide = true;
}

void add(SceneInstance& instance, const SoftBody& description) {
  btSoftRigidDynamicsWorld& world = *instance.world.soft_world();
  std::unique_ptr<btSoftBody> soft = std::visit(Make{world.getWorldInfo()}, description.value);
  btSoftBody::Material* const material = soft->m_materials[0];
  material->m_kLST = real(description.stiffness);
  material->m_kAST = real(description.stiffness);
  soft->generateBendingConstraints(2, material);
  // Shares by area would give pinned nodes a mass again; the nodes of a cloth are evenly spread anyway.
  soft->setTotalMass(real(description.mass), std::holds_alternative<BallSoft>(description.value));
  soft->m_cfg.kDP = real(description.damping);
  soft->m_cfg.kDF = real(description.friction);
  soft->m_cfg.piterations = description.iterations;
  soft->m_cfg.collisions = btSoftBody::fCollision::SDF_RS | btSoftBody::fCollision::VF_SS;
  soft->getCollisionShape()->setMargin(real(description.margin));
  instance.number(*soft);
  world.addSoftBody(soft.get());
  instance.soft_bodies.push_back(std::move(soft));
}

void start_soft_bodies(SceneInstance& instance) {
  // Built without being called for, beside multibodies: their world has none.
  if (instance.world.soft_world() == nullptr) return;
  for (const SoftBody& description : instance.scene.soft_bodies) add(instance, description);
  // Forgets distances to shapes that no soft body has been near for a while.
  instance.after_step(effects::soft_bodies, [&instance](double) {
    instance.world.soft_world()->getWorldInfo().m_sparsesdf.GarbageCollect();
  });
}

std::uint64_t count_moving_nodes(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for (const auto& soft : instance.soft_bodies)
    for (int i = 0; i < soft->m_nodes.size(); ++i) count += !soft->m_nodes[i].m_v.isZero();
  return count;
}

}  // namespace

const Effect soft_bodies{"soft_bodies",
                         "cloth and balls that give way",
                         "btSoftRigidDynamicsWorld in place of btDiscreteDynamicsWorld",
                         calls_for_soft_bodies,
                         {.prepare = prepare_soft_bodies, .start = start_soft_bodies},
                         {"moving nodes", count_moving_nodes}};

}  // namespace boxstream::effects
