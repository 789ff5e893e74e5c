// SPDX-License-Identifier: MIT
#include "simulation/simulation.hpp"

#include <algorithm>
#include <cmath>

#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include "simulation/broadphases.hpp"
#include "simulation/forces.hpp"
#include "simulation/pair_check.hpp"
#include "simulation/pair_list.hpp"
#include "simulation/profile_zones.hpp"
#include "simulation/rays.hpp"
#include "simulation/simulation_parts.hpp"
#include "simulation/state_hash.hpp"

namespace boxstream::scenes {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(std::chrono::nanoseconds time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

std::size_t object_count(const Scene& scene, const Expanded& expanded) {
  return expanded.bodies.size() + scene.sensors.size() + scene.characters.size() + scene.soft_bodies.size();
}

std::unique_ptr<btBroadphaseInterface> make_wrapped(const std::string& name, const Scene& scene,
                                                    std::size_t max_objects, const Simulation::Wrap& wrap) {
  auto broadphase = make_broadphase(name, scene.world.bounds, max_objects);
  return wrap ? wrap(std::move(broadphase)) : std::move(broadphase);
}

}  // namespace

Simulation::Impl::Impl(Simulation& owner, const Scene& description, const std::string& broadphase, const Wrap& wrap,
                       Expanded expanded)
    : self(owner),
      scene(description),
      broadphase_name(broadphase),
      world(scene, make_wrapped(broadphase, scene, object_count(scene, expanded), wrap)),
      things(scene, std::move(expanded), world) {
  world.after_pairs = [this] { on_pairs(); };
}

void Simulation::Impl::take_pairs() {
  list_pairs(world.broadphase(), pairs);
  ghost_overlaps = 0;
  for (const auto& sensor : things.sensors)
    ghost_overlaps += static_cast<std::uint64_t>(sensor->getNumOverlappingObjects());
  for (const Walker& walker : things.walkers)
    ghost_overlaps += static_cast<std::uint64_t>(walker.ghost().getNumOverlappingObjects());
  exact_pairs = want_exact ? overlapping_only(self, pairs).size() : 0;
}

void Simulation::Impl::on_pairs() noexcept {
  // Characters move their ghosts later in the step and get pairs at once, so with them only this moment will do.
  if (things.walkers.empty() && !observer) return;
  const auto start = Clock::now();
  try {
    take_pairs();
    if (observer) observer();
  } catch (...) {
    thrown = std::current_exception();
  }
  observing += Clock::now() - start;
}

void Simulation::Impl::before_step() {
  for (const Field& field : scene.fields)
    if (const auto* swirl = std::get_if<SwirlField>(&field)) apply_swirl(*swirl, things.bodies);
  for (const Moved& moved : things.moved) move_on(moved, scene.time.dt);
  for (Walker& walker : things.walkers) walker.steer(steps + 1, scene.time.dt);
}

void Simulation::Impl::after_step() {
  for (const Walker& walker : things.walkers) walker.push(world.dispatcher(), things.objects, scene.time.dt);
  // Forgets distances to shapes that no soft body has been near for a while.
  if (world.soft_world() != nullptr) world.soft_world()->getWorldInfo().m_sparsesdf.GarbageCollect();
}

Simulation::Simulation(const Scene& scene, const std::string& broadphase, const Wrap& wrap)
    : impl_(std::make_unique<Impl>(*this, scene, broadphase, wrap, expand(scene))) {}

Simulation::~Simulation() = default;

StepResult Simulation::step(const StepOptions& options) {
  Impl& d = *impl_;
  StepResult result;
  result.step = d.steps + 1;
  result.bodies = d.things.objects.size();
  if (options.events) std::swap(d.former_pairs, d.pairs);
  d.want_exact = options.exact_pairs;
  d.observing = {};
  d.before_step();
  {
    const ProfileZones zones;
    const auto start = Clock::now();
    d.world.world().stepSimulation(real(d.scene.time.dt), 0);
    const auto whole = Clock::now() - start - d.observing;
    result.update_aabbs_ms = milliseconds(zones.time(ProfileZones::update_aabbs));
    result.overlapping_pairs_ms = milliseconds(zones.time(ProfileZones::overlapping_pairs));
    result.broadphase_ms = result.update_aabbs_ms + result.overlapping_pairs_ms;
    result.dispatch_ms = milliseconds(zones.time(ProfileZones::dispatch));
    result.solve_ms = milliseconds(zones.time(ProfileZones::solve));
    result.step_ms = milliseconds(whole);
  }
  ++d.steps;
  if (d.thrown) std::rethrow_exception(std::exchange(d.thrown, nullptr));
  if (d.things.walkers.empty() && !d.observer) d.take_pairs();
  if (!d.scene.queries.empty()) {
    const auto start = Clock::now();
    for (const Query& query : d.scene.queries)
      if (const auto* fan = std::get_if<RayFan>(&query)) result.ray_hits += cast_rays(*fan, d.steps, d.world.world());
    result.rays_ms = milliseconds(Clock::now() - start);
  }
  d.after_step();
  result.pairs = d.pairs.size();
  result.exact_pairs = d.exact_pairs;
  result.ghost_overlaps = d.ghost_overlaps;
  if (options.events) {
    result.begun = count_missing(d.pairs, d.former_pairs);
    result.ended = count_missing(d.former_pairs, d.pairs);
  }
  if (options.hash) result.state_hash = state_hash();
  return result;
}

void Simulation::set_after_pairs(std::function<void()> observer) {
  impl_->observer = std::move(observer);
}

const Scene& Simulation::scene() const {
  return impl_->scene;
}
const std::string& Simulation::broadphase_name() const {
  return impl_->broadphase_name;
}
std::uint64_t Simulation::steps_done() const {
  return impl_->steps;
}
const std::vector<Pair>& Simulation::pairs() const {
  return impl_->pairs;
}
const std::vector<btCollisionObject*>& Simulation::objects() const {
  return impl_->things.objects;
}
btDynamicsWorld& Simulation::world() {
  return impl_->world.world();
}
btBroadphaseInterface& Simulation::broadphase() {
  return impl_->world.broadphase();
}
const btBroadphaseInterface& Simulation::broadphase() const {
  return impl_->world.broadphase();
}

std::uint64_t Simulation::state_hash() const {
  collect_state(objects(), impl_->state);
  return hash_of(impl_->state);
}

bool Simulation::is_finite() const {
  collect_state(objects(), impl_->state);
  return std::all_of(impl_->state.begin(), impl_->state.end(), [](float x) { return std::isfinite(x); });
}

std::uint64_t Simulation::outside() const {
  const Bounds& bounds = impl_->scene.world.bounds;
  std::uint64_t count = 0;
  for (const auto& body : impl_->things.bodies) {
    if (body->isStaticOrKinematicObject()) continue;
    const btVector3& place = body->getWorldTransform().getOrigin();
    for (std::size_t d = 0; d < 3; ++d) {
      const double x = place[static_cast<int>(d)];
      if (!(x >= bounds.min[d] && x <= bounds.max[d])) {
        ++count;
        break;
      }
    }
  }
  return count;
}

}  // namespace boxstream::scenes
