// SPDX-License-Identifier: MIT
#include "witnesses/simbody_model.hpp"

#include <stdexcept>

#include <Simbody.h>

namespace boxstream::witnesses::simbody {
namespace {

using SimTK::Constraint;
using SimTK::MobilizedBody;
using SimTK::Rotation;
using SimTK::SpatialVec;
using SimTK::State;
using SimTK::Transform;
using SimTK::Vec3;

Vec3 vector(const Numbers3& v) {
  return {v[0], v[1], v[2]};
}

Numbers3 numbers(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Transform place(const Pose& pose) {
  const auto& [x, y, z, w] = pose.rotation;
  return {Rotation(SimTK::Quaternion(w, x, y, z)), vector(pose.position)};
}

/// At the pivot, with the axis of the joint where Simbody has it: z of a Pin, x of a Slider.
Transform frame_of(const Joint& joint) {
  if (joint.kind == JointKind::hinge)
    return {Rotation(SimTK::UnitVec3(vector(joint.axis)), SimTK::ZAxis), vector(joint.pivot)};
  if (joint.kind == JointKind::slider)
    return {Rotation(SimTK::UnitVec3(vector(joint.axis)), SimTK::XAxis), vector(joint.pivot)};
  return vector(joint.pivot);
}

/// Pulls two points together in proportion to their distance, which Simbody's own springs divide by.
class Spring : public SimTK::Force::Custom::Implementation {
 public:
  Spring(const MobilizedBody& a, const Vec3& on_a, const MobilizedBody& b, const Vec3& on_b, const Joint& joint)
      : a_(a), b_(b), on_a_(on_a), on_b_(on_b), joint_(joint) {}

  void calcForce(const State& state, SimTK::Vector_<SpatialVec>& on_bodies, SimTK::Vector_<Vec3>&,
                 SimTK::Vector&) const override {
    const Vec3 way = a_.findStationLocationInGround(state, on_a_) - b_.findStationLocationInGround(state, on_b_);
    const Vec3 speed = a_.findStationVelocityInGround(state, on_a_) - b_.findStationVelocityInGround(state, on_b_);
    const Vec3 force = -joint_.stiffness * way - joint_.damping * speed;
    a_.applyForceToBodyPoint(state, on_a_, force, on_bodies);
    b_.applyForceToBodyPoint(state, on_b_, -force, on_bodies);
  }
  SimTK::Real calcPotentialEnergy(const State& state) const override {
    const Vec3 way = a_.findStationLocationInGround(state, on_a_) - b_.findStationLocationInGround(state, on_b_);
    return joint_.stiffness * way.normSqr() / 2;
  }

 private:
  MobilizedBody a_, b_;
  Vec3 on_a_, on_b_;
  Joint joint_;
};

class World {
 public:
  explicit World(const Model& model) : model_(model), placed_(model.bodies.size()), bodies_(model.bodies.size()) {
    if (model.gravity != Numbers3{}) SimTK::Force::UniformGravity(forces_, matter_, vector(model.gravity));
    std::vector<bool> used(model.joints.size());
    for (std::size_t k = 0; k < used.size(); ++k) used[k] = model.joints[k].kind == JointKind::spring;
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      while (hang_one(used)) {
      }
      if (placed_[i]) continue;
      bodies_[i] = MobilizedBody::Free(matter_.updGround(), Transform(), rigid(i), Transform());
      put(i, world, vector(model.bodies[i].start.position));
    }
    for (std::size_t k = 0; k < used.size(); ++k) {
      if (model.joints[k].kind == JointKind::spring) add_spring(model.joints[k]);
      if (!used[k]) close_loop(model.joints[k]);
    }
    system_.realizeTopology();
  }

  std::vector<Frame> run(double dt, std::size_t steps, double accuracy) {
    State state = system_.getDefaultState();
    for (const auto& [body, parent, frame] : order_) {
      if (parent == world && !hung_[body]) bodies_[body].setQToFitTransform(state, place(model_.bodies[body].start));
      system_.realize(state, SimTK::Stage::Position);
      // Of the joint's two frames, as the parent sees it.
      const SpatialVec mine = wanted(body, frame.p()), its = wanted(parent, frame.p());
      const SpatialVec across(~frame.R() * (mine[0] - its[0]), ~frame.R() * (mine[1] - its[1]));
      bodies_[body].setUToFitVelocity(state, across);
    }
    SimTK::RungeKuttaMersonIntegrator integrator(system_);
    integrator.setAccuracy(accuracy);
    integrator.setConstraintTolerance(accuracy);
    SimTK::TimeStepper stepper(system_, integrator);
    stepper.initialize(state);
    check_start(stepper.getState());
    std::vector<Frame> frames{frame_in(stepper.getState())};
    for (std::size_t step = 1; step <= steps; ++step) {
      stepper.stepTo(static_cast<double>(step) * dt);
      frames.push_back(frame_in(stepper.getState()));
    }
    return frames;
  }

 private:
  MobilizedBody& mobilized(std::size_t body) {
    if (body == world) return matter_.updGround();
    return bodies_[body];
  }
  bool is_there(std::size_t body) const { return body == world || placed_[body]; }
  Transform start_of(std::size_t body) const { return body == world ? Transform() : place(model_.bodies[body].start); }

  /// The velocity that a body is given at the start, at the point of it that is at `point`.
  SpatialVec wanted(std::size_t body, const Vec3& point) const {
    if (body == world) return SpatialVec(Vec3(0), Vec3(0));
    const Body& from = model_.bodies[body];
    const Vec3 spin = vector(from.spin), centre = start_of(body) * vector(from.centre);
    return {spin, vector(from.velocity) + spin % (point - centre)};
  }

  SimTK::Body::Rigid rigid(std::size_t i) const {
    const Body& body = model_.bodies[i];
    const auto& [x, y, z] = body.inertia;
    const auto& [xy, xz, yz] = body.products;
    const Vec3 centre = vector(body.centre);
    const SimTK::Inertia about_centre(x, y, z, xy, xz, yz);
    return SimTK::Body::Rigid(
        SimTK::MassProperties(body.mass, centre, about_centre.shiftFromMassCenter(centre, body.mass)));
  }

  void put(std::size_t body, std::size_t parent, const Transform& frame) {
    placed_[body] = true;
    order_.push_back({body, parent, frame});
  }

  /// A body on one that is there already, by the first joint that says so.
  bool hang_one(std::vector<bool>& used) {
    for (std::size_t k = 0; k < used.size(); ++k) {
      const Joint& joint = model_.joints[k];
      if (used[k] || is_there(joint.a) == is_there(joint.b)) continue;
      const std::size_t child = is_there(joint.a) ? joint.b : joint.a, parent = is_there(joint.a) ? joint.a : joint.b;
      const Transform frame = frame_of(joint);
      const Transform in_parent = ~start_of(parent) * frame, in_child = ~start_of(child) * frame;
      switch (joint.kind) {
        case JointKind::hinge:
          bodies_[child] = MobilizedBody::Pin(mobilized(parent), in_parent, rigid(child), in_child);
          break;
        case JointKind::slider:
          bodies_[child] = MobilizedBody::Slider(mobilized(parent), in_parent, rigid(child), in_child);
          break;
        case JointKind::fixed:
          bodies_[child] = MobilizedBody::Weld(mobilized(parent), in_parent, rigid(child), in_child);
          break;
        case JointKind::ball:
        case JointKind::spring:  // hangs nothing
          bodies_[child] = MobilizedBody::Ball(mobilized(parent), in_parent, rigid(child), in_child);
          break;
      }
      put(child, parent, frame);
      hung_[child] = true;
      used[k] = true;
      return true;
    }
    return false;
  }

  void close_loop(const Joint& joint) {
    if (joint.kind != JointKind::ball && joint.kind != JointKind::hinge)
      throw std::invalid_argument("a loop that is closed by neither a ball joint nor a hinge");
    const Vec3 pivot = vector(joint.pivot);
    Constraint::Ball(mobilized(joint.a), ~start_of(joint.a) * pivot, mobilized(joint.b), ~start_of(joint.b) * pivot);
  }

  void add_spring(const Joint& joint) {
    const Vec3 pivot = vector(joint.pivot);
    SimTK::Force::Custom(forces_, new Spring(mobilized(joint.a), ~start_of(joint.a) * pivot, mobilized(joint.b),
                                             ~start_of(joint.b) * pivot, joint));  // which owns it
  }

  /// Joints, and then the projection on loops, may have left less of the velocities than was asked for.
  void check_start(const State& state) const {
    const Frame frame = frame_in(state);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = model_.bodies[i];
      const Vec3 velocity = vector(frame.bodies[i].velocity), spin = vector(frame.bodies[i].spin);
      const double scale = 1 + vector(body.velocity).norm() + vector(body.spin).norm();
      if ((velocity - vector(body.velocity)).norm() + (spin - vector(body.spin)).norm() > 1e-5 * scale)
        throw std::invalid_argument("velocities that its joints do not allow");
    }
  }

  Frame frame_in(const State& state) const {
    system_.realize(state, SimTK::Stage::Dynamics);
    Frame frame;
    frame.energy = system_.calcEnergy(state);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      const MobilizedBody& body = bodies_[i];
      const SimTK::Quaternion q = body.getBodyRotation(state).convertRotationToQuaternion();
      frame.bodies.push_back({{numbers(body.getBodyOriginLocation(state)), {q[1], q[2], q[3], q[0]}},
                              numbers(body.findStationVelocityInGround(state, vector(model_.bodies[i].centre))),
                              numbers(body.getBodyAngularVelocity(state))});
    }
    return frame;
  }

  struct Hung {
    std::size_t body, parent;
    Transform frame;  // of the joint, in the world at the start
  };

  const Model& model_;
  SimTK::MultibodySystem system_;
  SimTK::SimbodyMatterSubsystem matter_{system_};
  SimTK::GeneralForceSubsystem forces_{system_};
  std::vector<bool> placed_;
  std::vector<bool> hung_ = std::vector<bool>(placed_.size());
  std::vector<MobilizedBody> bodies_;
  std::vector<Hung> order_;  // parents first
};

}  // namespace

std::vector<Frame> run(const Model& model, double dt, std::size_t steps, double accuracy) {
  return World(model).run(dt, steps, accuracy);
}

}  // namespace boxstream::witnesses::simbody
