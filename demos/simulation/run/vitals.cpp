// SPDX-License-Identifier: MIT
#include "simulation/run/vitals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include "formats/scene_model/expand.hpp"
#include "simulation/run/joint_error.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The least side of its box; infinite for planes, meshes and other shapes that are only a surface.
double thickness_of(const btCollisionObject& object) {
  const btCollisionShape* const shape = object.getCollisionShape();
  if (shape == nullptr || shape->isConcave() || shape->isInfinite() || shape->isSoftBody()) return infinity;
  btVector3 low, high;
  shape->getAabb(btTransform::getIdentity(), low, high);
  return double{std::min({high.x() - low.x(), high.y() - low.y(), high.z() - low.z()})};
}

bool has_damping(const Simulation& simulation) {
  const auto& bodies = simulation.expanded().bodies;
  return std::any_of(bodies.begin(), bodies.end(), [](const Body& body) {
    return body.traits.linear_damping != 0 || body.traits.angular_damping != 0;
  });
}

/// Joints that only hold, and so do no work.
bool only_holds(const Joint& joint) {
  const auto* const hinge = std::get_if<HingeJoint>(&joint.value);
  return std::holds_alternative<BallJoint>(joint.value) || std::holds_alternative<FixedJoint>(joint.value) ||
         (hinge != nullptr && !hinge->limits && !hinge->motor);
}

bool has_takers(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const auto& joints = simulation.expanded().joints;
  return !std::all_of(joints.begin(), joints.end(), only_holds) || has_damping(simulation) || !scene.fields.empty() ||
         !scene.soft_bodies.empty() || !scene.vehicles.empty() || !scene.characters.empty();
}

/// The world itself, to which joints hold bodies, has none.
int number_of(const btRigidBody& body) {
  return &body == &btTypedConstraint::getFixedBody() ? -1 : body.getUserIndex();
}

std::string text_of(const Check& check, double value, std::uint64_t step) {
  return fmt::format("{} {} {:.4g}: it was {:.4g} after step {}", name_of(check.metric), name_of(check.op), check.value,
                     value, step);
}

}  // namespace

bool falls_alike(double a, double b) {
  return std::abs(a - b) <= most_fall * std::max(1.0, std::abs(b));
}

VitalsMonitor::VitalsMonitor(Simulation& simulation, std::uint64_t energy_every)
    : simulation_(simulation),
      energy_every_(energy_every),
      anything_takes_energy_(has_takers(simulation)),
      first_energy_(simulation.metric(Check::Metric::energy)) {
  for (const btCollisionObject* const object : simulation.objects()) thickness_.push_back(thickness_of(*object));
}

double VitalsMonitor::thickness(const btCollisionObject& object) const {
  const int index = object.getUserIndex();
  return index >= 0 && static_cast<std::size_t>(index) < thickness_.size() ? thickness_[static_cast<std::size_t>(index)]
                                                                           : infinity;
}

void VitalsMonitor::look_at_contacts() {
  vitals_.end_share = 0;
  btDispatcher& dispatcher = *simulation_.world().getDispatcher();
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getNumContacts() == 0) continue;
    const btCollisionObject &a = *manifold.getBody0(), &b = *manifold.getBody1();
    if (!a.hasContactResponse() || !b.hasContactResponse()) continue;
    anything_takes_energy_ = true;
    double depth = 0;
    for (int k = 0; k < manifold.getNumContacts(); ++k)
      depth = std::max(depth, -double{manifold.getContactPoint(k).getDistance()});
    if (depth > vitals_.deepest) {
      vitals_.deepest = depth;
      vitals_.when_deepest = {simulation_.steps_done(), {a.getUserIndex(), b.getUserIndex()}};
    }
    vitals_.end_share = std::max(vitals_.end_share, depth / std::min(thickness(a), thickness(b)));
  }
  vitals_.deepest_share = std::max(vitals_.deepest_share, vitals_.end_share);
}

void VitalsMonitor::look() {
  look_at_contacts();
  const JointError joints = joint_error(simulation_.world());
  if (joints.distance > vitals_.joint_gap) {
    vitals_.joint_gap = joints.distance;
    vitals_.when_widest = {simulation_.steps_done(),
                           {number_of(joints.widest->getRigidBodyA()), number_of(joints.widest->getRigidBodyB())}};
  }
  vitals_.joint_share = std::max(vitals_.joint_share, joints.share);
  if (simulation_.steps_done() % energy_every_ != 0) return;
  const EnergyBalance balance = simulation_.energy_balance();
  vitals_.most_in_world = std::max(vitals_.most_in_world, balance.in_world);
  vitals_.most_gained = std::max(vitals_.most_gained, -balance.lost());
}

Vitals VitalsMonitor::vitals() const {
  Vitals all = vitals_;
  all.energy = simulation_.energy_balance();
  all.most_in_world = std::max(all.most_in_world, all.energy.in_world);
  all.most_gained = std::max(all.most_gained, -all.energy.lost());
  // What bodies take with them that leave is no loss.
  all.vanished = std::min(all.energy.lost(), first_energy_ - simulation_.metric(Check::Metric::energy));
  all.outside = simulation_.outside();
  all.conserves = !anything_takes_energy_;
  const auto& checks = simulation_.scene().checks;
  for (const CheckResult& result : simulation_.check_results())
    if (result.asked && !result.passed)
      all.failed_checks.push_back(text_of(checks[result.check], result.value, result.step));
  return all;
}

std::string unsound(const Vitals& v) {
  return unsound(v, Known{v.outside});
}

std::string unsound(const Vitals& v, const Known& known) {
  const EnergyBalance& energy = v.energy;
  if (!v.failed_checks.empty()) return "breaks a check of the scene: " + v.failed_checks.front();
  if (energy.worst)
    return fmt::format("gains {:.3g} J in step {} that no work explains, {:.3g} % of what is in the world",
                       energy.worst->energy, energy.worst->step, 100 * energy.worst->share);
  if (v.most_gained > most_energy_gained * (v.most_in_world - v.most_gained))
    return fmt::format("gains {:.3g} J that no work explains, of {:.3g} J in the world", v.most_gained,
                       v.most_in_world);
  if (v.conserves && v.vanished > most_energy_vanished * v.most_in_world)
    return fmt::format("loses {:.3g} J of {:.3g} J, which nothing takes", v.vanished, v.most_in_world);
  if (v.outside > known.least_outside)
    return fmt::format("{} bod{} left the scene", v.outside - known.least_outside,
                       v.outside - known.least_outside == 1 ? "y" : "ies");
  if (known.height != nullptr && v.height_loss > known.height->height_loss &&
      !falls_alike(std::max(0.0, v.height_loss), std::max(0.0, known.height->height_loss)))
    return fmt::format("loses {:.3g} % of its height, where {} loses {:.2g} %", 100 * v.height_loss, known.height_of,
                       100 * std::max(0.0, known.height->height_loss));
  if (v.elsewhere > most_elsewhere)
    return fmt::format("bodies are elsewhere than in the reference, by {:.3g} % of their way on average",
                       100 * v.elsewhere);
  if (const Vitals* const right = known.energy_lost;
      right != nullptr &&
      std::abs(energy.lost_for_good() - right->energy.lost_for_good()) > most_energy_apart * right->most_in_world)
    return fmt::format("loses {:.3g} J of {:.3g} J, where the reference loses {:.3g} J", energy.lost_for_good(),
                       v.most_in_world, right->energy.lost_for_good());
  if (v.joint_share > most_joint_gap)
    return fmt::format("a joint is {:.3g} m apart, {:.3g} % of what it holds", v.joint_gap, 100 * v.joint_share);
  if (v.end_share > most_depth_at_end || v.deepest_share > most_depth)
    return fmt::format("bodies are in each other by {:.3g} m, up to {:.3g} % of the thinner one", v.deepest,
                       100 * v.deepest_share);
  return {};
}

}  // namespace boxstream::scenes
