// SPDX-License-Identifier: MIT
#include "trajectory.hpp"

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletDynamics/Dynamics/btDynamicsWorld.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/scene_model/expand.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {
namespace {

/// By what the scene says of bodies, and not by what they are now: one that is frozen on its way is one of them still.
bool is_dynamic(const scenes::Simulation& simulation, std::size_t object) {
  const std::vector<scenes::Body>& bodies = simulation.expanded().bodies;
  return object < bodies.size() ? effects::is_dynamic(bodies[object])
                                : !simulation.objects()[object]->isStaticOrKinematicObject();
}

/// Of two unit quaternions, in radians. The distance of quaternions keeps its digits for small angles, which their
/// product does not.
double turn(const btQuaternion& a, const btQuaternion& b) {
  const auto length = [&](double sign) {
    double sum = 0;
    for (int i = 0; i < 4; ++i) sum += std::pow(double{a[i]} + sign * double{b[i]}, 2);
    return std::sqrt(sum);
  };
  return 4 * std::asin(std::min(1.0, std::min(length(1), length(-1)) / 2));
}

double first_difference(const std::map<std::pair<int, int>, double>& seen,
                        const std::map<std::pair<int, int>, double>& other, double lag, double end) {
  double first = end;
  for (const auto& [pair, time] : seen) {
    const auto found = other.find(pair);
    if (found == other.end() ? time + lag < end : std::abs(found->second - time) > lag) first = std::min(first, time);
  }
  return first;
}

}  // namespace

double size_of_bodies(const scenes::Simulation& simulation) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < simulation.objects().size(); ++i) {
    const btCollisionShape* const shape = simulation.objects()[i]->getCollisionShape();
    if (!is_dynamic(simulation, i) || shape == nullptr) continue;
    btVector3 low, high;
    shape->getAabb(btTransform::getIdentity(), low, high);
    sum += double{std::min({high.x() - low.x(), high.y() - low.y(), high.z() - low.z()})};
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

Frame frame_of(const scenes::Simulation& simulation) {
  Frame frame;
  for (std::size_t i = 0; i < simulation.objects().size(); ++i) {
    if (!is_dynamic(simulation, i)) continue;
    const btTransform place = simulation.pose(i);
    frame.positions.push_back(place.getOrigin());
    frame.rotations.push_back(place.getRotation());
  }
  return frame;
}

void record_contacts(scenes::Simulation& simulation, double time, Trajectory& trajectory) {
  btDispatcher& dispatcher = *simulation.world().getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() == 0) continue;
    trajectory.contacts.emplace(std::minmax(manifold.getBody0()->getUserIndex(), manifold.getBody1()->getUserIndex()),
                                time);
  }
}

void record_contacts_within(scenes::Simulation& simulation, Trajectory& trajectory) {
  simulation.set_after_pairs([&] {
    // Contacts are still those that the substep before found.
    record_contacts(simulation, static_cast<double>(simulation.steps_done()) * simulation.scene().time.dt, trajectory);
  });
}

double extent(const Frame& frame) {
  if (frame.positions.empty()) return 0;
  btVector3 low = frame.positions.front(), high = low;
  for (const btVector3& place : frame.positions) {
    low.setMin(place);
    high.setMax(place);
  }
  return double{(high - low).length()};
}

double distance(const Frame& a, const Frame& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.positions.size(); ++i) sum += double{(a.positions[i] - b.positions[i]).length2()};
  return a.positions.empty() ? 0 : std::sqrt(sum / static_cast<double>(a.positions.size()));
}

double angle(const Frame& a, const Frame& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.rotations.size(); ++i) sum += std::pow(turn(a.rotations[i], b.rotations[i]), 2);
  return a.rotations.empty() ? 0 : std::sqrt(sum / static_cast<double>(a.rotations.size())) * 180 / std::numbers::pi;
}

double divergence_time(const Trajectory& a, const Trajectory& b, double lag, double end) {
  return std::min(first_difference(a.contacts, b.contacts, lag, end),
                  first_difference(b.contacts, a.contacts, lag, end));
}

}  // namespace boxstream::accuracy
