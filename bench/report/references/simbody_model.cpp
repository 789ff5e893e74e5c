// SPDX-License-Identifier: MIT
#include "references/simbody_model.hpp"

#include <Simbody.h>

namespace boxstream::report::simbody {
namespace {

using SimTK::Constraint;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;

constexpr double accuracy_of_steps = 1e-10;

Vec3 vector(const Numbers3& v) {
  return {v[0], v[1], v[2]};
}

Transform place(const Pose& pose) {
  const auto& [x, y, z, w] = pose.rotation;
  return {Rotation(SimTK::Quaternion(w, x, y, z)), vector(pose.position)};
}

/// At the pivot, with z along the axis: the axis of a Pin.
Transform frame_of(const Joint& joint) {
  if (!joint.hinge) return vector(joint.pivot);
  return {Rotation(SimTK::UnitVec3(vector(joint.axis)), SimTK::ZAxis), vector(joint.pivot)};
}

class World {
 public:
  explicit World(const Model& model) : model_(model), placed_(model.bodies.size()), bodies_(model.bodies.size()) {
    if (model.gravity != Numbers3{}) SimTK::Force::UniformGravity(forces_, matter_, vector(model.gravity));
    std::vector<bool> used(model.joints.size());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      while (hang_one(used)) {
      }
      if (placed_[i]) continue;
      bodies_[i] = MobilizedBody::Free(matter_.updGround(), Transform(), rigid(i), Transform());
      placed_[i] = true;
      free_.push_back(i);
    }
    for (std::size_t k = 0; k < used.size(); ++k)
      if (!used[k]) close_loop(model.joints[k]);
    system_.realizeTopology();
  }

  std::vector<std::vector<Pose>> run(double dt, std::size_t steps) {
    State state = system_.getDefaultState();
    for (const std::size_t i : free_) {
      const Body& body = model_.bodies[i];
      bodies_[i].setQToFitTransform(state, place(body.start));
      bodies_[i].setUToFitVelocity(state, SimTK::SpatialVec(vector(body.spin), vector(body.velocity)));
    }
    SimTK::RungeKuttaMersonIntegrator integrator(system_);
    integrator.setAccuracy(accuracy_of_steps);
    integrator.setConstraintTolerance(accuracy_of_steps);
    SimTK::TimeStepper stepper(system_, integrator);
    stepper.initialize(state);
    std::vector<std::vector<Pose>> poses;
    for (std::size_t step = 1; step <= steps; ++step) {
      stepper.stepTo(static_cast<double>(step) * dt);
      poses.push_back(poses_in(stepper.getState()));
    }
    return poses;
  }

 private:
  MobilizedBody& mobilized(std::size_t body) {
    if (body == world) return matter_.updGround();
    return bodies_[body];
  }
  bool is_there(std::size_t body) const { return body == world || placed_[body]; }
  Transform start_of(std::size_t body) const { return body == world ? Transform() : place(model_.bodies[body].start); }

  SimTK::Body::Rigid rigid(std::size_t i) const {
    const Body& body = model_.bodies[i];
    const auto& [x, y, z] = body.inertia;
    return SimTK::Body::Rigid(SimTK::MassProperties(body.mass, Vec3(0), SimTK::Inertia(x, y, z)));
  }

  /// A body on one that is there already, by the first joint that says so.
  bool hang_one(std::vector<bool>& used) {
    for (std::size_t k = 0; k < used.size(); ++k) {
      const Joint& joint = model_.joints[k];
      if (used[k] || is_there(joint.a) == is_there(joint.b)) continue;
      const std::size_t child = is_there(joint.a) ? joint.b : joint.a, parent = is_there(joint.a) ? joint.a : joint.b;
      const Transform in_parent = ~start_of(parent) * frame_of(joint), in_child = ~start_of(child) * frame_of(joint);
      if (joint.hinge)
        bodies_[child] = MobilizedBody::Pin(mobilized(parent), in_parent, rigid(child), in_child);
      else
        bodies_[child] = MobilizedBody::Ball(mobilized(parent), in_parent, rigid(child), in_child);
      placed_[child] = true;
      used[k] = true;
      return true;
    }
    return false;
  }

  void close_loop(const Joint& joint) {
    const Vec3 pivot = vector(joint.pivot);
    Constraint::Ball(mobilized(joint.a), ~start_of(joint.a) * pivot, mobilized(joint.b), ~start_of(joint.b) * pivot);
  }

  std::vector<Pose> poses_in(const State& state) const {
    system_.realize(state, SimTK::Stage::Position);
    std::vector<Pose> poses;
    for (const MobilizedBody& body : bodies_) {
      const Vec3 p = body.getBodyOriginLocation(state);
      const SimTK::Quaternion q = body.getBodyRotation(state).convertRotationToQuaternion();
      poses.push_back({{p[0], p[1], p[2]}, {q[1], q[2], q[3], q[0]}});
    }
    return poses;
  }

  const Model& model_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  std::vector<bool> placed_;
  std::vector<MobilizedBody> bodies_;
  std::vector<std::size_t> free_;
};

}  // namespace

std::vector<std::vector<Pose>> run(const Model& model, double dt, std::size_t steps) {
  return World(model).run(dt, steps);
}

}  // namespace boxstream::report::simbody
