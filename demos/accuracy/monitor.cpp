// SPDX-License-Identifier: MIT
#include "monitor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_model/expand.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/run/simulation.hpp"
#include "usual_knobs.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Check;
using scenes::Simulation;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Visits the dynamic bodies that are in the world.
template <class Visit>
void for_each_dynamic(const Simulation& simulation, Visit visit) {
  for (const btCollisionObject* const object : simulation.objects())
    if (const btRigidBody* const body = btRigidBody::upcast(object);
        body != nullptr && !body->isStaticOrKinematicObject() && body->isInWorld())
      visit(*body);
}

/// Turns the world so that gravity pulls along -y; nothing where it pulls nowhere, or everywhere in turn.
btTransform upright(const scenes::WorldSettings& world) {
  const btVector3 up = -scenes::vector(world.gravity);
  if (world.tumbling || up.isZero()) return btTransform::getIdentity();
  return btTransform(shortestArcQuat(up.normalized(), btVector3(0, 1, 0)));
}

double relative(const double (&now)[3], const double (&first)[3]) {
  const double change = std::hypot(now[0] - first[0], now[1] - first[1], now[2] - first[2]);
  return change / std::hypot(first[0], first[1], first[2]);
}

bool is_kinematic_and_moves(const scenes::Body& body) {
  return body.traits.type == scenes::BodyType::kinematic &&
         (body.velocity != scenes::Vec3{} || body.spin != scenes::Vec3{});
}

/// Whether something else than gravity makes bodies fast: those that move as prescribed, machines, fields.
bool is_driven(const Simulation& simulation) {
  const scenes::Scene& scene = simulation.scene();
  const auto& bodies = simulation.expanded().bodies;
  const effects::Effect* const drivers[] = {&effects::motors, &effects::conveyors, &effects::vehicles,
                                            &effects::characters};
  return scene.world.tumbling || !scene.fields.empty() ||
         std::any_of(bodies.begin(), bodies.end(), is_kinematic_and_moves) ||
         std::any_of(std::begin(drivers), std::end(drivers),
                     [&](const effects::Effect* driver) { return effects::is_on(simulation.plan(), *driver); });
}

/// What falling through the whole scene, on top of the speeds at the start, comes to; infinite where bodies are driven.
double natural_speed(Simulation& simulation) {
  const scenes::Scene& scene = simulation.scene();
  if (is_driven(simulation)) return std::numeric_limits<double>::infinity();
  const scenes::Bounds& bounds = scene.world.bounds;
  const double way =
      std::hypot(bounds.max[0] - bounds.min[0], bounds.max[1] - bounds.min[1], bounds.max[2] - bounds.min[2]);
  return simulation.metric(Check::Metric::max_speed) +
         std::sqrt(2 * double{simulation.world().getGravity().length()} * way);
}

}  // namespace

Depths contact_depths(Simulation& simulation) {
  Depths depths;
  btDispatcher& dispatcher = *simulation.world().getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k, ++depths.count) {
      const double depth = std::max(0.0, -double{manifold.getContactPoint(k).getDistance()});
      depths.sum_of_squares += depth * depth;
      depths.deepest = std::max(depths.deepest, depth);
    }
  }
  return depths;
}

Monitor::Monitor(Simulation& simulation)
    : simulation_(simulation),
      first_(momenta()),
      first_energy_(simulation.metric(Check::Metric::energy)),
      energy_scale_(simulation.energy_scale()),
      upright_(upright(simulation.scene().world)),
      first_top_(top()),
      base_(std::numeric_limits<double>::infinity()),
      speed_limit_(10 * natural_speed(simulation)) {
  for_each_dynamic(simulation, [&](const btRigidBody& body) { base_ = std::min(base_, heights(body)[0]); });
}

/// Against gravity, of its lowest and its highest point.
std::array<double, 2> Monitor::heights(const btRigidBody& body) const {
  btVector3 low, high;
  body.getCollisionShape()->getAabb(upright_ * body.getWorldTransform(), low, high);
  return {low.y(), high.y()};
}

Monitor::Momenta Monitor::momenta() const {
  Momenta sum;
  for_each_dynamic(simulation_, [&](const btRigidBody& body) {
    const btMatrix3x3& basis = body.getWorldTransform().getBasis();
    const btVector3 local = basis.transpose() * body.getAngularVelocity();
    double spin[3];
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = body.getInvInertiaDiagLocal()[axis];
      spin[axis] = inverse > 0 ? double{local[axis]} / inverse : 0;
    }
    const btVector3& x = body.getWorldTransform().getOrigin();
    const btVector3& v = body.getLinearVelocity();
    for (int axis = 0; axis < 3; ++axis) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      sum.linear[axis] += double{v[axis]} / body.getInvMass();
      sum.angular[axis] += (double{x[next]} * v[last] - double{x[last]} * v[next]) / body.getInvMass();
      for (int k = 0; k < 3; ++k) sum.angular[axis] += double{basis[axis][k]} * spin[k];
    }
  });
  return sum;
}

double Monitor::top() const {
  double highest = -std::numeric_limits<double>::infinity();
  for_each_dynamic(simulation_, [&](const btRigidBody& body) { highest = std::max(highest, heights(body)[1]); });
  return highest;
}

double Monitor::of_body(Measure::Kind kind, std::size_t index) const {
  const auto* const body = btRigidBody::upcast(simulation_.objects()[index]);
  switch (kind) {
    case Measure::Kind::body_speed:
      return body == nullptr ? nan : double{body->getLinearVelocity().length()};
    case Measure::Kind::body_spin:
      return body == nullptr ? nan : double{body->getAngularVelocity().length()};
    default:
      return double{
          simulation_.pose(index).getOrigin()[static_cast<int>(kind) - static_cast<int>(Measure::Kind::body_x)]};
  }
}

double Monitor::value(const Measure& measure, std::optional<std::size_t> body, std::optional<std::size_t> joint) const {
  if (is_of_body(measure)) return body ? of_body(measure.kind, *body) : nan;
  switch (measure.kind) {
    case Measure::Kind::metric:
      return simulation_.metric(measure.metric);
    case Measure::Kind::momentum_drift:
      return relative(momenta().linear, first_.linear);
    case Measure::Kind::angular_momentum_drift:
      return relative(momenta().angular, first_.angular);
    case Measure::Kind::energy_change:
      return (simulation_.metric(Check::Metric::energy) - first_energy_) / energy_scale_;
    case Measure::Kind::joint_error:
      return joints(joint).distance;
    case Measure::Kind::joint_angle:
      return joints(joint).degrees;
    case Measure::Kind::mean_square_penetration:
      return contact_depths(simulation_).mean_square();
    case Measure::Kind::height_loss:
      return height_loss();
    case Measure::Kind::tunnelled:
      return static_cast<double>(simulation_.outside()) / static_cast<double>(count_dynamic(simulation_.expanded()));
    default:
      return nan;
  }
}

double Monitor::height_loss() const {
  return (first_top_ - top()) / (first_top_ - base_);
}

scenes::JointError Monitor::joints(std::optional<std::size_t> joint) const {
  const btDynamicsWorld& world = simulation_.world();
  const int count = world.getNumConstraints();
  // Those of multibodies are no constraints, and have no gap.
  const bool all_are_there = static_cast<std::size_t>(count) == simulation_.expanded().joints.size();
  if (count == 0 || (joint && !all_are_there)) {
    scenes::JointError none;
    none.distance = none.degrees = none.share = nan;
    return none;
  }
  if (!joint) return scenes::joint_error(world);
  return scenes::joint_error(*const_cast<btDynamicsWorld&>(world).getConstraint(static_cast<int>(*joint)));
}

bool Monitor::has_exploded() const {
  return speed_limit_ > 0 && simulation_.metric(Check::Metric::max_speed) > speed_limit_;
}

}  // namespace boxstream::accuracy
