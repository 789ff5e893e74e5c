// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <numbers>

#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"
#include "engine/convert.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

struct Ask {
  Stage& stage;

  void operator()(const RayFan& fan) const {
    const double turned = static_cast<double>(stage.steps) * fan.degrees * std::numbers::pi / 180;
    const btVector3 from = vector(fan.from);
    for (int i = 0; i < fan.count; ++i) {
      const double angle = turned + 2 * std::numbers::pi * i / fan.count;
      const btVector3 to =
          from + btVector3(real(fan.radius * std::cos(angle)), real(-fan.drop), real(fan.radius * std::sin(angle)));
      btCollisionWorld::ClosestRayResultCallback nearest(from, to);
      stage.world.world().rayTest(from, to, nearest);
      stage.queries.ray_hits += nearest.hasHit();
    }
  }
  void operator()(const BoxQuery& query) const {
    struct Count final : btBroadphaseAabbCallback {
      std::uint64_t found = 0;
      bool process(const btBroadphaseProxy*) override {
        ++found;
        return true;
      }
    } count;
    stage.world.broadphase().aabbTest(vector(query.bounds.min), vector(query.bounds.max), count);
    stage.queries.boxes += count.found;
  }
  void operator()(const ContactQuery& query) const {
    struct Count final : btCollisionWorld::ContactResultCallback {
      std::uint64_t found = 0;
      btScalar addSingleResult(btManifoldPoint&, const btCollisionObjectWrapper*, int, int,
                               const btCollisionObjectWrapper*, int, int) override {
        ++found;
        return 0;
      }
    } count;
    btRigidBody& body = *stage.bodies[query.body];
    if (!body.isInWorld()) return;
    stage.world.world().contactTest(&body, count);
    stage.queries.contacts += count.found;
  }
};

std::optional<Call> called_for(const Subject& subject) {
  return first_of(subject.scene.queries, "/queries", "a query");
}

void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.collide = true;
}

void start(Stage& stage) {
  if (stage.scene.queries.empty()) return;
  stage.after_step(effects::queries, [&stage](double) {
    const auto start = scenes::now(stage.clock);
    stage.queries = {};
    for (const Query& query : stage.scene.queries) std::visit(Ask{stage}, query);
    stage.queries.time = scenes::now(stage.clock) - start;
  });
}

}  // namespace

const Effect queries{"queries",
                     "rays, boxes and contacts that are asked for after each step",
                     "rayTest, aabbTest and contactTest",
                     called_for,
                     prepare,
                     nullptr,
                     start};

}  // namespace boxstream::effects
