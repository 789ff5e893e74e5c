// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/effects/tunnelling.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

// Sweeping of fast bodies, from the start or from when one is fast.
namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_ccd(const Subject& subject) {
  const std::vector<double> safe = safe_motions(subject);
  const double substep = subject.scene.time.dt / subject.scene.time.substeps;
  return first_body_at(subject, [&](std::size_t i) -> std::string {
    const Body& body = subject.expanded.bodies[i];
    // Bullet sweeps no links.
    if (!is_dynamic(body) || subject.trees.has_body(i)) return {};
    if (body.traits.ccd && can_hit(subject, i)) return "given";
    const double motion = std::hypot(body.velocity[0], body.velocity[1], body.velocity[2]) * substep;
    if (motion <= safe[i]) return {};
    return fmt::format("starts with {:.3g} m in a step, {:.3g} m are safe", motion, safe[i]);
  });
}

void prepare_ccd(const Subject&, WorldRecipe& recipe) {
  recipe.continuous = true;
}

/// Bullet sweeps a body only in steps in which it moves by more than its threshold, in a world that sweeps. It leaves
/// out hits that it comes no deeper than 4 cm into, whatever the size of the body: here what is safe for the smallest.
void start_ccd(SceneInstance& instance) {
  const std::vector<double> safe = safe_motions(instance.subject);
  const std::vector<double> half_thickness = half_thicknesses(instance.expanded.shapes);
  btScalar& shallow = instance.world.world().getDispatchInfo().m_allowedCcdPenetration;
  for (std::size_t i = 0; i < safe.size(); ++i) {
    const BodyTraits& traits = instance.expanded.bodies[i].traits;
    if (!traits.ccd && std::isinf(safe[i])) continue;
    // Bullet takes a threshold of 0 for "never".
    const double half = std::max(half_thickness[traits.shape], 1e-4);
    const double share = safe_share(instance.expanded.shapes[traits.shape]);
    const Ccd ccd = traits.ccd.value_or(Ccd{share * half, half / 2});
    instance.bodies[i]->setCcdMotionThreshold(real(ccd.threshold));
    instance.bodies[i]->setCcdSweptSphereRadius(real(ccd.radius));
    shallow = std::min(shallow, real(share * half));
  }
}

std::optional<Call> calls_for_ccd_on_demand(const Subject& subject) {
  const std::vector<double> safe = safe_motions(subject);
  return first_body_at(subject, [&](std::size_t i) -> std::string {
    return std::isinf(safe[i]) ? "" : fmt::format("could come to move more than {:.3g} m in a step", safe[i]);
  });
}

/// What a fast body could jump over in a substep, of all whose boxes are near.
class InTheWay final : public btBroadphaseAabbCallback {
 public:
  InTheWay(const btRigidBody& body, double safe, btScalar dt) : body_(body), safe_(safe), dt_(dt) {
    body.getAabb(low_, high_);
  }

  bool is_near(btBroadphaseInterface& broadphase) {
    // What is faster looks for itself: the two come closer by twice the motion of this body at most.
    const btScalar reach = 2 * body_.getLinearVelocity().length() * dt_;
    const btVector3 margin(reach, reach, reach);
    broadphase.aabbTest(low_ - margin, high_ + margin, *this);
    return found_;
  }

  bool process(const btBroadphaseProxy* proxy) override {
    const auto& object = *static_cast<const btCollisionObject*>(proxy->m_clientObject);
    const btBroadphaseProxy& own = *body_.getBroadphaseProxy();
    if (&object == &body_ || !body_.checkCollideWith(&object) ||
        (own.m_collisionFilterGroup & proxy->m_collisionFilterMask) == 0 ||
        (proxy->m_collisionFilterGroup & own.m_collisionFilterMask) == 0)
      return true;
    btVector3 motion = body_.getLinearVelocity() * dt_;
    if (const btRigidBody* const other = btRigidBody::upcast(&object)) motion -= other->getLinearVelocity() * dt_;
    btVector3 low = low_, high = high_;
    low.setMin(low_ + motion);
    high.setMax(high_ + motion);
    found_ = found_ ||
             (double{motion.length()} > safe_ && TestAabbAgainstAabb2(low, high, proxy->m_aabbMin, proxy->m_aabbMax));
    return !found_;
  }

 private:
  const btRigidBody& body_;
  double safe_;
  btScalar dt_;
  btVector3 low_, high_;
  bool found_ = false;
};

/// Compares how far bodies are about to move in a substep with what is safe. Once one moves too far, all bodies are
/// swept, in that substep already.
class SpeedMonitor {
 public:
  explicit SpeedMonitor(SceneInstance& instance) : instance_(instance) {
    const std::vector<double> safe = safe_motions(instance.subject);
    for (std::size_t i = 0; i < safe.size(); ++i) {
      btVector3 low, high;
      instance.bodies[i]->getAabb(low, high);
      low_.setMin(low);
      high_.setMax(high);
      if (!std::isinf(safe[i])) bodies_.push_back({instance.bodies[i].get(), i, safe[i]});
    }
  }

  void operator()(double dt) {
    btDispatcherInfo& info = instance_.world.world().getDispatchInfo();
    if (info.m_useContinuous) return;
    for (const Monitored& each : bodies_) {
      const btRigidBody& body = *each.body;
      if (!body.isActive() || !body.isInWorld()) continue;
      const btVector3 motion = body.getLinearVelocity() * real(dt);
      const double length = motion.length();
      if (length <= each.safe) continue;
      if (!is_within_the_start(body, motion) &&
          !InTheWay(body, each.safe, real(dt)).is_near(instance_.world.broadphase()))
        continue;
      info.m_useContinuous = true;
      instance_.switched_on.push_back(
          {&ccd, instance_.steps + 1,
           fmt::format("body {} moves {:.3g} m in a step, {:.3g} m are safe", each.index, length, each.safe)});
      start_ccd(instance_);
      return;
    }
  }

 private:
  struct Monitored {
    btRigidBody* body;
    std::size_t index;
    double safe;  // metres a substep
  };

  /// Whether a body moves in the box in which all bodies were when the scene began: there, no search for what is in its
  /// way is worth its time.
  bool is_within_the_start(const btRigidBody& body, const btVector3& motion) const {
    btVector3 low, high;
    body.getAabb(low, high);
    low.setMin(low + motion);
    high.setMax(high + motion);
    return TestAabbAgainstAabb2(low, high, low_, high_);
  }

  SceneInstance& instance_;
  std::vector<Monitored> bodies_;
  btVector3 low_{BT_LARGE_FLOAT, BT_LARGE_FLOAT, BT_LARGE_FLOAT}, high_{-low_};
};

void start_ccd_on_demand(SceneInstance& instance) {
  const SpeedMonitor monitor(instance);
  instance.before_motion(ccd_on_demand, monitor);
  // A sensor goes by boxes, which are set before the solver runs: those of a body that got an impulse must be long by
  // then.
  if (!instance.scene.sensors.empty()) instance.before_substep(ccd_on_demand, monitor);
}

std::uint64_t count_swept(const SceneInstance& instance) {
  return instance.world.swept_hits;
}

std::uint64_t count_switched_on(const SceneInstance& instance) {
  return instance.switched_on.size();
}

}  // namespace

const Effect ccd{"ccd",
                 "fast bodies do not jump over what is in their way",
                 "boxes that cover the motion of a step; sweeps of fast bodies",
                 calls_for_ccd,
                 {.prepare = prepare_ccd, .start = start_ccd},
                 {"hits of swept bodies", count_swept, Effect::Activity::of_run}};

const Effect ccd_on_demand{"ccd_on_demand",
                           "bodies are swept from when one becomes fast",
                           "a comparison of speeds after the solver of each substep, which switches ccd on",
                           calls_for_ccd_on_demand,
                           {.start = start_ccd_on_demand},
                           {"times it switched ccd on", count_switched_on, Effect::Activity::of_run}};

}  // namespace boxstream::effects
