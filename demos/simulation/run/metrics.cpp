// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "simulation/run/energy_account.hpp"
#include "simulation/run/simulation_parts.hpp"

namespace boxstream::scenes {
namespace {

/// Visits the dynamic bodies that are in the world.
template <class Visit>
void for_each_dynamic(const effects::SceneInstance& instance, Visit visit) {
  for (const auto& body : instance.bodies)
    if (!body->isStaticOrKinematicObject() && body->isInWorld()) visit(*body);
}

double energy(const effects::SceneInstance& instance) {
  const btVector3 gravity = instance.world.world().getGravity();
  double sum = energy_of_springs(instance);
  for_each_dynamic(instance, [&](const btRigidBody& body) { sum += energy_of(body, gravity); });
  return sum;
}

double momentum(const effects::SceneInstance& instance) {
  double sum[3] = {};
  for_each_dynamic(instance, [&](const btRigidBody& body) {
    for (int axis = 0; axis < 3; ++axis) sum[axis] += double{body.getLinearVelocity()[axis]} / body.getInvMass();
  });
  return std::hypot(sum[0], sum[1], sum[2]);
}

double max_speed(const effects::SceneInstance& instance) {
  double most = 0;
  for_each_dynamic(instance, [&](const btRigidBody& body) {
    const btVector3& v = body.getLinearVelocity();
    most = std::max(most, std::hypot(double{v.x()}, double{v.y()}, double{v.z()}));
  });
  return most;
}

/// y of the lowest and of the highest body, by the points that the scene places them by.
std::array<double, 2> heights(const effects::SceneInstance& instance) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::array<double, 2> range{infinite, -infinite};
  for_each_dynamic(instance, [&](const btRigidBody& body) {
    const double y{instance.described(static_cast<std::size_t>(body.getUserIndex())).getOrigin().y()};
    range = {std::min(range[0], y), std::max(range[1], y)};
  });
  return range;
}

double sleeping(const effects::SceneInstance& instance) {
  double count = 0;
  for_each_dynamic(instance, [&](const btRigidBody& body) { count += !body.isActive(); });
  return count;
}

double max_penetration(const effects::SceneInstance& instance) {
  double deepest = 0;
  btDispatcher& dispatcher = instance.world.dispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    for (int k = 0; k < manifold.getNumContacts(); ++k)
      deepest = std::max(deepest, -double{manifold.getContactPoint(k).getDistance()});
  }
  return deepest;
}

}  // namespace

double Simulation::energy_scale() const {
  const effects::SceneInstance& instance = impl_->instance;
  const double scale = std::max(std::abs(energy(instance)), energy_in_world(instance));
  return scale > 0 ? scale : std::numeric_limits<double>::quiet_NaN();
}

double Simulation::metric(Check::Metric metric) const {
  const Impl& d = *impl_;
  switch (metric) {
    case Check::Metric::missed_pairs:
      return static_cast<double>(d.missed_pairs);
    case Check::Metric::finite:
      return is_finite() ? 1 : 0;
    case Check::Metric::outside:
      return static_cast<double>(outside());
    case Check::Metric::max_penetration:
      return max_penetration(d.instance);
    case Check::Metric::energy:
      return energy(d.instance);
    case Check::Metric::energy_drift:
      return std::abs(energy(d.instance) - d.first_energy) / d.energy_scale;
    case Check::Metric::momentum:
      return momentum(d.instance);
    case Check::Metric::max_speed:
      return max_speed(d.instance);
    case Check::Metric::residual:
      return d.residual;
    case Check::Metric::sleeping:
      return sleeping(d.instance);
    case Check::Metric::pairs:
      return static_cast<double>(d.pairs.size());
    case Check::Metric::lowest:
      return heights(d.instance)[0];
    case Check::Metric::highest:
      return heights(d.instance)[1];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace boxstream::scenes
