// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <boxstream/function_ref.hpp>
#include <boxstream/pair.hpp>

#include "formats/scene_model/scene.hpp"
#include "measure/stopwatch.hpp"
#include "simulation/effects/plan.hpp"
#include "simulation/engine/drawable.hpp"
#include "simulation/engine/row_solver.hpp"
#include "simulation/run/energy_account.hpp"

class btBroadphaseInterface;
class btCollisionObject;
class btDynamicsWorld;
class btTransform;

namespace boxstream::scenes {

struct Expanded;

/// What to find out about each step beside stepping; none of it is inside the times.
struct StepOptions {
  bool events = true;        ///< count pairs begun and ended
  bool exact_pairs = false;  ///< count pairs whose boxes really overlap
  bool hash = true;          ///< state hash
  bool energy = true;        ///< `Simulation::energy_balance`
};

/// One step. Times are in milliseconds of the clock of the simulation.
struct StepResult {
  std::uint64_t step = 0;    ///< 1 is the first
  std::uint64_t bodies = 0;  ///< objects in the broad-phase: bodies, sensors, characters, soft bodies
  std::uint64_t pairs = 0;   ///< in the broad-phase's pair cache after calculateOverlappingPairs
  std::uint64_t exact_pairs = 0;
  std::uint64_t begun = 0;
  std::uint64_t ended = 0;
  std::uint64_t ghost_overlaps = 0;  ///< entries in the lists of all ghosts (sensors and characters)
  double update_aabbs_ms = 0;
  double overlapping_pairs_ms = 0;
  double broadphase_ms = 0;  ///< the sum of the two above
  double dispatch_ms = 0;    ///< the narrow phase
  double solve_ms = 0;       ///< contacts and joints
  double step_ms = 0;
  double lost_ms = 0;  ///< that went by without the thread running: others had the processor, or it waited for a disk
  std::uint64_t ray_hits = 0;  ///< of the scene's queries, which are made when the step is over and not part of it
  std::uint64_t query_boxes = 0;
  std::uint64_t query_contacts = 0;
  double queries_ms = 0;
  std::vector<effects::SensorEvent> sensor_events;  ///< by sensor, those that left first
  std::uint64_t state_hash = 0;  ///< of place, rotation and velocities of all bodies, characters and soft nodes
};

/// What became of one check of the scene.
struct CheckResult {
  std::size_t check = 0;  ///< index into the scene's checks
  bool asked = false;     ///< its step has come
  bool passed = false;
  std::uint64_t step = 0;  ///< after which `value` was; the first that failed, else the last one evaluated
  double value = 0;
};

/// How often an effect did something.
struct EffectActivity {
  const effects::Effect* effect;
  std::uint64_t count;  ///< of its `activity.unit`, summed over steps; 0: it was on and never acted
};

/// How often the hooks of an effect were called.
struct HookCalls {
  std::string effect;
  std::uint64_t calls = 0;
};

/// A scene running on Bullet: a world and everything in it, made of the effects that the scene calls for. Owns all of
/// it and destroys it in Bullet's order.
///
/// The same scene and the same broad-phase give the same state hashes, step for step.
/// Threads: one at a time; two Simulations may not step at once in one process (Bullet's profile zones are global).
class Simulation {
 public:
  /// Puts another broad-phase around the one that a scene runs on, to record or change calls. Called once, before
  /// the first object is made.
  using Wrap = std::function<std::unique_ptr<btBroadphaseInterface>(std::unique_ptr<btBroadphaseInterface>)>;

  /// Throws UnknownBroadphase, SceneError (a shape that Bullet cannot build; an effect that is required and not called
  /// for, or forbidden and called for), std::bad_alloc.
  Simulation(const Scene& scene, const std::string& broadphase, const Wrap& wrap = {},
             effects::Extent extent = effects::Extent::only_called);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// By a given plan, made by `effects::plan` for this scene: what is on in it is built.
  Simulation(const Scene& scene, const std::string& broadphase, const Wrap& wrap, effects::Plan plan);

  StepResult step(const StepOptions& options = {});

  /// A step without measurements: no times, no pairs, no hash. Checks of the scene are evaluated; energy is accounted
  /// for if `energy`.
  void advance(bool energy = false);

  /// Called within each step right after calculateOverlappingPairs, the one moment when pairs and boxes agree. Its time
  /// is not counted. May read everything, must change nothing; what it throws comes out of `step`.
  void set_after_pairs(std::function<void()> callback);

  const Scene& scene() const;
  /// The bodies of the scene, those of its generators too, in order of creation.
  const Expanded& expanded() const;
  const effects::Plan& plan() const;
  const SolverRows& solver_rows() const;
  std::vector<HookCalls> hook_calls() const;
  /// By the plan, or switched on since, in the order of the plan.
  std::vector<const effects::Effect*> effects_on() const;
  /// Effects of which the plan left open whether they are needed, and when and why they were, in order.
  const std::vector<effects::SwitchedOn>& switched_on() const;
  /// What times are measured by: processor time, or elapsed time where the broad-phase has threads.
  measure::Clock clock() const;
  /// What effects that are on did, in the order of the plan. What a step leaves is counted in `step` alone; what the
  /// solver and hooks count by themselves (`Activity::of_run`) in `advance` and warm-up too. An effect of which nothing
  /// can tell is left out.
  std::vector<EffectActivity> activity() const;
  /// Times that a body was found outside the bounds, if the scene says what happens then.
  std::uint64_t left() const;

  /// Of the steps that accounted for energy, which `step` does unless told otherwise, and `advance` if told to. Looks
  /// at all bodies.
  EnergyBalance energy_balance() const;

  /// Joules that are in the world now, which a change of energy is a share of: counted from the origin, or from the
  /// lowest point of a dynamic body, whichever is more. NaN where no dynamic body is in the world.
  double energy_scale() const;

  /// As it is now, between two steps. `energy_drift` compares with the time before the first step.
  double metric(Check::Metric metric) const;
  /// The scene's checks, as far as they were evaluated until now; this evaluates those of the end.
  std::vector<CheckResult> check_results() const;

  const std::string& broadphase_name() const;
  Census census() const;
  /// Whole steps; the one that is running does not count.
  std::uint64_t steps_done() const;
  std::uint64_t state_hash() const;

  /// Pairs as indices of objects in order of creation, sorted: as left by the last step (taken right after
  /// calculateOverlappingPairs if they are needed there), so comparable between broad-phases.
  const std::vector<Pair>& pairs() const;

  /// All collision objects in order of creation; `getUserIndex()` of each is its place here. One that is not in the
  /// world now has no broad-phase handle.
  const std::vector<btCollisionObject*>& objects() const;

  /// Where an object is, by its number: a body as its scene describes it, and not where Bullet has its centre of mass
  /// and principal axes.
  btTransform pose(std::size_t object) const;

  /// True if every coordinate and velocity is finite.
  bool is_finite() const;
  /// Dynamic bodies whose centre is outside the bounds of the scene.
  std::uint64_t outside() const;

  void for_each_drawable(FunctionRef<void(const Drawable&)> visit) const;
  /// Places and radii (in metres) of the wheels of all vehicles, as the last step left them; a wheel turns about its x.
  void for_each_wheel(FunctionRef<void(const btTransform& place, float radius)> visit) const;

  btDynamicsWorld& world();
  const btDynamicsWorld& world() const;
  btBroadphaseInterface& broadphase();
  const btBroadphaseInterface& broadphase() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// First place where what was built differs from what the scene's `expect` block says, as text; empty if none.
std::string check_expectations(const Scene& scene, const Census& census);

}  // namespace boxstream::scenes
