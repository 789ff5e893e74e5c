// SPDX-License-Identifier: MIT
#include "boxes/inputs.hpp"

#include <cmath>

#include <btBulletDynamicsCommon.h>

#include "boxes/pair_difference.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "inputs/batches.hpp"
#include "inputs/motion.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::report {
namespace {

constexpr std::uint64_t seed = 1;

void take_boxes(const std::vector<const btCollisionObject*>& bodies, std::vector<Aabb>& boxes) {
  for (const btCollisionObject* const body : bodies) {
    const btBroadphaseProxy& proxy = *body->getBroadphaseHandle();
    Aabb box{};
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<float>(proxy.m_aabbMin[d]);
      box.max[d] = static_cast<float>(proxy.m_aabbMax[d]);
    }
    boxes.push_back(box);
  }
}

}  // namespace

std::size_t touching_pairs(btDynamicsWorld& world, bool dynamic_only) {
  std::size_t count = 0;
  btDispatcher& dispatcher = *world.getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (dynamic_only &&
        (manifold.getBody0()->isStaticOrKinematicObject() || manifold.getBody1()->isStaticOrKinematicObject()))
      continue;
    for (int point = 0; point < manifold.getNumContacts(); ++point)
      if (manifold.getContactPoint(point).getDistance() <= 0) {
        ++count;
        break;
      }
  }
  return count;
}

Frames bake(const Baking& baking) {
  scenes::Scene scene = scenes::load_scene(baking.scene);
  std::size_t generated = 0;
  {
    const scenes::Simulation small(scene, "boxstream");
    generated = small.census().dynamic;
  }
  if (generated != baking.n)
    scene = scenes::scaled(scene, static_cast<double>(baking.n) / static_cast<double>(generated));
  scenes::Simulation simulation(scene, "boxstream");
  std::vector<const btCollisionObject*> bodies;
  for (const btCollisionObject* const object : simulation.objects())
    if (!object->isStaticOrKinematicObject() && object->getBroadphaseHandle() != nullptr) bodies.push_back(object);
  // Where boxes and pairs agree; of several substeps the last one counts.
  std::vector<Aabb> now;
  simulation.set_after_pairs([&] {
    now.clear();
    take_boxes(bodies, now);
  });
  const scenes::StepOptions nothing_else{false, false, false};
  for (std::size_t step = 0; step < baking.warm_up; ++step) simulation.step(nothing_else);
  Frames frames;
  double touching = 0, pairs = 0;
  for (std::size_t frame = 0; frame < baking.frames; ++frame) {
    simulation.step(nothing_else);
    frames.boxes.push_back(now);
    frames.pairs.push_back(reference_pairs(now));
    touching += static_cast<double>(touching_pairs(simulation.world(), true));
    pairs += static_cast<double>(frames.pairs.back().size());
  }
  frames.in_contact = touching / pairs;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) frames.moved.push_back(i);
  return frames;
}

Frames brownian(const std::string& batch, std::size_t n, double share, double step, std::size_t frames) {
  bench::MovingBoxes moving(bench::scaled_to_unit_sides(batches::make(batch, n, seed)), bench::Brownian{share, step},
                            seed);
  Frames result;
  result.in_contact = std::nan("");
  result.moved.assign(moving.moved().begin(), moving.moved().end());
  for (std::size_t frame = 0; frame < frames; ++frame) {
    result.boxes.emplace_back(moving.boxes().begin(), moving.boxes().end());
    result.pairs.push_back(reference_pairs(moving.boxes()));
    moving.next_frame();
  }
  return result;
}

}  // namespace boxstream::report
