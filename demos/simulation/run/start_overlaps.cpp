// SPDX-License-Identifier: MIT
#include "simulation/run/start_overlaps.hpp"

#include <algorithm>
#include <limits>

#include <btBulletDynamicsCommon.h>

#include "simulation/effects/tunnelling.hpp"
#include "simulation/engine/moved_apart.hpp"
#include "simulation/engine/world_recipe.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes {
namespace {

constexpr std::size_t most = 100'000;

/// How far one of two boxes has to move to leave the other, along an axis: two bodies are never deeper in each other.
double depth_of_boxes(const btRigidBody& a, const btRigidBody& b) {
  btVector3 low, high, other_low, other_high;
  a.getAabb(low, high);
  b.getAabb(other_low, other_high);
  double depth = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    depth = std::min({depth, double{high[axis]} - other_low[axis], double{other_high[axis]} - low[axis]});
  return depth;
}

struct Deepest final : btCollisionWorld::ContactResultCallback {
  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper*, int, int,
                           const btCollisionObjectWrapper*, int, int) override {
    depth = std::max(depth, -double{point.getDistance()});
    return 0;
  }
  double depth = 0;
};

bool can_push(btDispatcher& dispatcher, const btRigidBody* a, const btRigidBody* b) {
  return a != nullptr && b != nullptr && !(a->isStaticOrKinematicObject() && b->isStaticOrKinematicObject()) &&
         dispatcher.needsCollision(a, b) && dispatcher.needsResponse(a, b);
}

}  // namespace

StartOverlaps overlaps_at_start(const Scene& scene) {
  Scene still = scene;
  still.time.warmup_steps = 0;
  still.solver.precision = precision_here;  // hardly one of these is closer to a bound than their numbers are fine
  Simulation simulation(still, "boxstream");
  const std::vector<double> half = effects::half_thicknesses(simulation.expanded().shapes);
  const std::vector<Body>& bodies = simulation.expanded().bodies;
  btDynamicsWorld& world = simulation.world();
  const auto body = [&](std::uint32_t index) { return btRigidBody::upcast(simulation.objects()[index]); };
  const auto bound = [&](Pair pair) {
    return deep_from(2 * half[bodies[pair.a].traits.shape], 2 * half[bodies[pair.b].traits.shape]);
  };

  std::vector<StartOverlap> near;  // of boxes
  for (const Pair pair : expected_pairs(simulation)) {
    if (std::max(pair.a, pair.b) >= bodies.size() || !can_push(*world.getDispatcher(), body(pair.a), body(pair.b)))
      continue;
    const double depth = depth_of_boxes(*body(pair.a), *body(pair.b));
    if (depth > bound(pair)) near.push_back({pair.a, pair.b, depth});
  }
  const auto is_deeper = [](const StartOverlap& x, const StartOverlap& y) { return x.depth > y.depth; };
  std::stable_sort(near.begin(), near.end(), is_deeper);

  StartOverlaps found;
  found.all = near.size() <= most;
  near.resize(std::min(near.size(), most));
  for (StartOverlap& each : near) {
    Deepest deepest;
    world.contactPairTest(body(each.a), body(each.b), deepest);
    each.depth = deepest.depth;
    if (each.depth > bound(Pair{each.a, each.b})) found.deepest.push_back(each);
  }
  std::stable_sort(found.deepest.begin(), found.deepest.end(), is_deeper);
  return found;
}

}  // namespace boxstream::scenes
