// SPDX-License-Identifier: MIT
#include "simulation/effects/flow.hpp"

#include <algorithm>

#include "simulation/effects/field_kit.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::effects {

using scenes::real;
using scenes::Windward;

Flow::Flow(SceneInstance& instance, const btVector3& velocity, double density, double coefficient)
    : instance_(instance),
      velocity_(velocity),
      factor_(density / 2 * coefficient),
      surfaces_(for_each_shape<Windward>(instance)) {}

void Flow::push(double dt) const {
  for_each_moving(instance_, [&](std::size_t i, btRigidBody& body) {
    const Windward& surface = *surfaces_[i];
    const btMatrix3x3& basis = body.getWorldTransform().getBasis();
    const btVector3 flow = (velocity_ - velocity_left(body, dt)) * basis, spin = spin_left(body, dt) * basis;
    Windward::Push push = surface.push(flow, spin);
    if (push.force.isZero() && push.torque.isZero()) return;
    // What is light takes on the velocity of the flow, and is not thrown beyond it: neither its middle nor its rim.
    const double speed = double{flow.length()}, rim = double{spin.length()} * surface.reach();
    const double gain = factor_ * double{push.force.length()} * body.getInvMass() * dt;
    double share = factor_;
    if (const double most = speed + rim / 16; gain > most) share *= most / gain;
    body.applyCentralForce(basis * push.force * real(share));
    const double turn = share * double{(push.torque * body.getInvInertiaDiagLocal()).length()} * dt * surface.reach();
    if (const double most = std::max(speed, rim); turn > most) share *= most / turn;
    body.applyTorque(basis * push.torque * real(share));
  });
}

}  // namespace boxstream::effects
