// SPDX-License-Identifier: MIT
#include "simulation/run/simulation.hpp"

#include <algorithm>
#include <cmath>

#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include "formats/scene_model/scene_error.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/broadphases.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/profile_zones.hpp"
#include "simulation/run/simulation_parts.hpp"
#include "simulation/run/state_hash.hpp"

namespace boxstream::scenes {
namespace {

std::size_t object_count(const Scene& scene, const Expanded& expanded) {
  return expanded.bodies.size() + scene.sensors.size() + scene.characters.size() + scene.soft_bodies.size();
}

/// Bullet computes with numbers of one precision in a program.
const Scene& checked(const Scene& scene) {
  if (scene.solver.precision == precision_here) return scene;
  throw SceneError(
      scene.file +
      (precision_here == Precision::single
           ? ": /solver/precision: only boxstream simulate and boxstream accuracy have worlds of double precision"
           : ": /solver/precision: this program has worlds of double precision only"));
}

WorldRecipe recipe_of(const effects::Plan& plan, const effects::Subject& subject) {
  WorldRecipe recipe;
  recipe.solver.m_numIterations = subject.scene.solver.iterations;
  recipe.solver.m_leastSquaresResidualThreshold = real(subject.scene.solver.residual);
  for (const effects::Decision& decision : plan)
    if (decision.on && decision.effect->build.prepare != nullptr) decision.effect->build.prepare(subject, recipe);
  return recipe;
}

std::unique_ptr<btBroadphaseInterface> make_wrapped(const std::string& name, const Scene& scene,
                                                    std::size_t max_objects, Executor* executor,
                                                    const Simulation::Wrap& wrap) {
  auto broadphase = make_broadphase(name, scene.world.bounds, max_objects, executor);
  return wrap ? wrap(std::move(broadphase)) : std::move(broadphase);
}

}  // namespace

Simulation::Impl::Impl(Simulation& owner, const Scene& description, const std::string& broadphase, const Wrap& wrap,
                       effects::Plan decided, Expanded expanded)
    : self(owner),
      scene(checked(description)),
      broadphase_name(broadphase),
      plan(std::move(decided)),
      recipe(recipe_of(plan, {scene, expanded})),
      executor(recipe.threads > 1 ? make_executor(recipe.threads) : nullptr),
      world(recipe, make_wrapped(broadphase, scene, object_count(scene, expanded), executor.get(), wrap)),
      instance(scene, std::move(expanded), world),
      may_leave(is_on(plan, effects::out_of_bounds)),
      monitored(is_on(plan, effects::monitors)) {
  if (executor) instance.clock = measure::Clock::wall;
  instance.build(plan);
  world.after_pairs = [this] { on_pairs(); };
}

void Simulation::Impl::take_pairs() {
  list_pairs(world.broadphase(), pairs);
  ghost_overlaps = 0;
  for (const auto& sensor : instance.sensors)
    ghost_overlaps += static_cast<std::uint64_t>(sensor->getNumOverlappingObjects());
  for (const effects::Walker& walker : instance.walkers)
    ghost_overlaps += static_cast<std::uint64_t>(walker.ghost().getNumOverlappingObjects());
  exact_pairs = want_exact ? overlapping_only(self, pairs).size() : 0;
}

// Characters move their ghosts later in the step and get pairs at once, and bodies may be taken out of the world after
// it: then only the moment after calculateOverlappingPairs will do.
bool Simulation::Impl::pairs_within_step() const {
  return after_pairs || count_missed || !instance.walkers.empty() || may_leave;
}

void Simulation::Impl::on_pairs() noexcept {
  if (plain || !pairs_within_step()) return;
  const auto start = measure::now(instance.clock);
  try {
    take_pairs();
    if (count_missed) missed_pairs += count_missing(expected_pairs(self), pairs);
    if (after_pairs) after_pairs();
  } catch (...) {
    thrown = std::current_exception();
  }
  observing += measure::now(instance.clock) - start;
}

Simulation::Simulation(const Scene& scene, const std::string& broadphase, const Wrap& wrap, effects::Extent extent) {
  Expanded expanded = expand(scene);
  effects::Plan plan = effects::plan(effects::Subject{scene, expanded}, extent);
  impl_ = std::make_unique<Impl>(*this, scene, broadphase, wrap, std::move(plan), std::move(expanded));
  impl_->warm_up();
}

Simulation::Simulation(const Scene& scene, const std::string& broadphase, const Wrap& wrap, effects::Plan plan)
    : impl_(std::make_unique<Impl>(*this, scene, broadphase, wrap, std::move(plan), expand(scene))) {
  impl_->warm_up();
}

Simulation::~Simulation() = default;

void Simulation::Impl::warm_up() {
  for (int i = 0; i < scene.time.warmup_steps; ++i) advance();
  instance.steps = 0;
  if (monitored) begin_checks();
}

void Simulation::Impl::advance() {
  instance.run(instance.first, scene.time.dt);
  if (accounting) energy->begin_step();
  for (int i = 0; i < scene.time.substeps; ++i) {
    instance.run(instance.before, instance.substep);
    if (accounting) energy->before_substep();
    world.world().stepSimulation(real(instance.substep), 0);
    instance.run(instance.after, instance.substep);
  }
  ++instance.steps;
  if (accounting) energy->end_step(instance.steps);
  instance.run(instance.last, scene.time.dt);
}

void Simulation::Impl::account_for(bool on) {
  if (on == accounting) return;
  accounting = on;
  if (on && !energy) {
    energy.emplace(instance);
    world.hooks.after_motion = [this, then = std::move(world.hooks.after_motion)](double dt) {
      if (then) then(dt);
      if (accounting) energy->after_motion(dt);
    };
  }
  if (!on) energy->interrupt();
  world.hooks.acting_on = nullptr;
  if (on) world.hooks.acting_on = [this](const btRigidBody& body) { energy->acting_on(body); };
  world.solver().count_work(on ? &world.hooks.acting_on : nullptr);
}

StepResult Simulation::step(const StepOptions& options) {
  Impl& d = *impl_;
  effects::SceneInstance& instance = d.instance;
  StepResult result;
  d.plain = false;
  result.step = instance.steps + 1;
  result.bodies = instance.objects.size();
  if (options.events) std::swap(d.former_pairs, d.pairs);
  d.want_exact = options.exact_pairs;
  d.account_for(options.energy);
  d.observing = {};
  {
    const ProfileZones zones(instance.clock);
    const auto start = measure::now(instance.clock), wall_start = measure::now(measure::Clock::wall);
    d.advance();
    const auto time = measure::now(instance.clock) - start, wall = measure::now(measure::Clock::wall) - wall_start;
    const auto whole = time - d.observing - instance.queries.time;
    result.update_aabbs_ms = measure::milliseconds(zones.time(ProfileZones::update_aabbs));
    result.overlapping_pairs_ms = measure::milliseconds(zones.time(ProfileZones::overlapping_pairs));
    result.broadphase_ms = result.update_aabbs_ms + result.overlapping_pairs_ms;
    result.dispatch_ms = measure::milliseconds(zones.time(ProfileZones::dispatch));
    result.solve_ms = measure::milliseconds(zones.time(ProfileZones::solve));
    result.step_ms = measure::milliseconds(whole);
    result.lost_ms = std::max(0.0, measure::milliseconds(wall - time));
  }
  if (d.thrown) std::rethrow_exception(std::exchange(d.thrown, nullptr));
  if (!d.pairs_within_step()) d.take_pairs();
  instance.observe_activity(d.plan);
  result.ray_hits = instance.queries.ray_hits;
  result.query_boxes = instance.queries.boxes;
  result.query_contacts = instance.queries.contacts;
  result.queries_ms = measure::milliseconds(instance.queries.time);
  result.sensor_events = instance.sensor_events;
  result.pairs = d.pairs.size();
  result.exact_pairs = d.exact_pairs;
  result.ghost_overlaps = d.ghost_overlaps;
  if (options.events) {
    result.begun = count_missing(d.pairs, d.former_pairs);
    result.ended = count_missing(d.former_pairs, d.pairs);
  }
  if (d.monitored) d.observe();
  if (options.hash) result.state_hash = state_hash();
  return result;
}

void Simulation::advance(bool energy) {
  Impl& d = *impl_;
  d.plain = !d.monitored && !d.after_pairs;
  d.account_for(energy);
  d.advance();
  if (d.thrown) std::rethrow_exception(std::exchange(d.thrown, nullptr));
  if (!d.monitored) return;
  if (!d.pairs_within_step()) d.take_pairs();
  d.observe();
}

void Simulation::set_after_pairs(std::function<void()> after_pairs) {
  impl_->after_pairs = std::move(after_pairs);
}

const Scene& Simulation::scene() const {
  return impl_->scene;
}
const Expanded& Simulation::expanded() const {
  return impl_->instance.expanded;
}
const std::string& Simulation::broadphase_name() const {
  return impl_->broadphase_name;
}
const effects::Plan& Simulation::plan() const {
  return impl_->plan;
}
const SolverRows& Simulation::solver_rows() const {
  return impl_->world.solver().rows();
}
measure::Clock Simulation::clock() const {
  return impl_->instance.clock;
}
std::uint64_t Simulation::left() const {
  return impl_->instance.left;
}
EnergyBalance Simulation::energy_balance() const {
  return impl_->energy ? impl_->energy->balance() : EnergyBalance{};
}
std::uint64_t Simulation::steps_done() const {
  return impl_->instance.steps;
}
const std::vector<Pair>& Simulation::pairs() const {
  return impl_->pairs;
}
const std::vector<btCollisionObject*>& Simulation::objects() const {
  return impl_->instance.objects;
}
std::vector<HookCalls> Simulation::hook_calls() const {
  std::vector<HookCalls> calls;
  const effects::SceneInstance& instance = impl_->instance;
  for (const auto* const hooks : {&instance.first, &instance.before, &instance.solver, &instance.motion,
                                  &instance.moved, &instance.after, &instance.last})
    for (const effects::Hook& hook : *hooks) calls.push_back({hook.effect->name, hook.calls});
  return calls;
}
const std::vector<effects::SwitchedOn>& Simulation::switched_on() const {
  return impl_->instance.switched_on;
}
std::vector<const effects::Effect*> Simulation::effects_on() const {
  std::vector<const effects::Effect*> on;
  for (const effects::Decision& decision : impl_->plan)
    if (impl_->instance.is_on(decision)) on.push_back(decision.effect);
  return on;
}
std::vector<EffectActivity> Simulation::activity() const {
  std::vector<EffectActivity> activity;
  const std::vector<std::uint64_t>& counts = impl_->instance.activity;
  for (std::size_t i = 0; i < counts.size(); ++i)
    if (const effects::Decision& decision = impl_->plan[i];
        impl_->instance.is_on(decision) && decision.effect->activity.count != nullptr)
      activity.push_back({decision.effect, counts[i]});
  return activity;
}
btDynamicsWorld& Simulation::world() {
  return impl_->world.world();
}
const btDynamicsWorld& Simulation::world() const {
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

btTransform Simulation::pose(std::size_t object) const {
  const effects::SceneInstance& instance = impl_->instance;
  return object < instance.bodies.size() ? instance.described(object) : instance.objects[object]->getWorldTransform();
}

bool Simulation::is_finite() const {
  collect_state(objects(), impl_->state);
  return std::all_of(impl_->state.begin(), impl_->state.end(), [](btScalar x) { return std::isfinite(x); });
}

std::uint64_t Simulation::outside() const {
  // By what the scene says: a body that is frozen is static to Bullet.
  const std::vector<Body>& bodies = expanded().bodies;
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    count += effects::is_dynamic(bodies[i]) &&
             !is_inside(impl_->scene.world.bounds, impl_->instance.described(i).getOrigin());
  return count;
}

}  // namespace boxstream::scenes
