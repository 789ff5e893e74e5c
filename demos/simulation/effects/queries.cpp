// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <numbers>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

struct Ask {
  SceneInstance& instance;

  void operator()(const RayFan& fan) const {
    const double turned = static_cast<double>(instance.steps) * fan.degrees * std::numbers::pi / 180;
    const btVector3 from = vector(fan.from);
    for (int i = 0; i < fan.count; ++i) {
      const double angle = turned + 2 * std::numbers::pi * i / fan.count;
      const btVector3 to =
          from + btVector3(real(fan.radius * std::cos(angle)), real(-fan.drop), real(fan.radius * std::sin(angle)));
      btCollisionWorld::ClosestRayResultCallback nearest(from, to);
      instance.world.world().rayTest(from, to, nearest);
      instance.queries.ray_hits += nearest.hasHit();
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
    instance.world.broadphase().aabbTest(vector(query.bounds.min), vector(query.bounds.max), count);
    instance.queries.boxes += count.found;
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
    btRigidBody& body = *instance.bodies[query.body];
    if (!body.isInWorld()) return;
    instance.world.world().contactTest(&body, count);
    instance.queries.contacts += count.found;
  }
};

std::optional<Call> calls_for_queries(const Subject& subject) {
  return first_of(subject.scene.queries, "/queries", "a query");
}

void prepare_queries(const Subject&, WorldRecipe& recipe) {
  recipe.collide = true;
}

void start_queries(SceneInstance& instance) {
  if (instance.scene.queries.empty()) return;
  instance.after_step(effects::queries, [&instance](double) {
    const auto start = measure::now(instance.clock);
    instance.queries = {};
    for (const Query& query : instance.scene.queries) std::visit(Ask{instance}, query);
    instance.queries.time = measure::now(instance.clock) - start;
  });
}

std::uint64_t count_hits(const SceneInstance& instance) {
  return instance.queries.ray_hits + instance.queries.boxes + instance.queries.contacts;
}

}  // namespace

const Effect queries{
    "queries",         "queries of rays, boxes and contacts after each step", "rayTest, aabbTest and contactTest",
    calls_for_queries, {.prepare = prepare_queries, .start = start_queries},  {"hits", count_hits}};

}  // namespace boxstream::effects
