// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "formats/import/bullet_parts.hpp"

namespace boxstream::imports {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

/// Strength of Bullet's hinge motors is an impulse per step; this is how long a step usually is.
constexpr double usual_step = 1.0 / 60;

/// Scenes say joints by where they are at the start, with both bodies' frames the same there. What is here says how
/// bodies may move from where they are now.
class Constraint {
 public:
  Constraint(btTypedConstraint& constraint, bool collide, const KnownBodies& bodies, Fragment& out, LeftOut& left_out)
      : constraint_(constraint), collide_(collide), bodies_(bodies), out_(out), left_out_(left_out) {}

  void add() {
    a_ = find(constraint_.getRigidBodyA());
    b_ = find(constraint_.getRigidBodyB());
    if (!may_move(a_) && !may_move(b_)) return miss("constraints between things that do not move");
    switch (constraint_.getConstraintType()) {
      case POINT2POINT_CONSTRAINT_TYPE: {
        const auto& ball = static_cast<btPoint2PointConstraint&>(constraint_);
        return put({{"type", "ball"}}, world(true) * ball.getPivotInA(), std::nullopt);
      }
      case HINGE_CONSTRAINT_TYPE:
        return add_hinge(static_cast<btHingeConstraint&>(constraint_));
      case CONETWIST_CONSTRAINT_TYPE:
        return add_cone_twist(static_cast<btConeTwistConstraint&>(constraint_));
      case SLIDER_CONSTRAINT_TYPE:
        return add_slider(static_cast<btSliderConstraint&>(constraint_));
      case D6_CONSTRAINT_TYPE:
        return add_six_dof(static_cast<btGeneric6DofConstraint&>(constraint_));
      case D6_SPRING_CONSTRAINT_TYPE: {
        auto& free = static_cast<btGeneric6DofSpringConstraint&>(constraint_);
        for (int i = 0; i < 6; ++i) has_spring_ = has_spring_ || free.isSpringEnabled(i);
        return add_six_dof(free);
      }
      case D6_SPRING_2_CONSTRAINT_TYPE: {  // btFixedConstraint too
        auto& free = static_cast<btGeneric6DofSpring2Constraint&>(constraint_);
        for (int i = 0; i < 3; ++i)
          has_spring_ = has_spring_ || free.getTranslationalLimitMotor()->m_enableSpring[i] ||
                        free.getRotationalLimitMotor(i)->m_enableSpring;
        return add_six_dof(free);
      }
      default:
        return miss("constraints of type " + std::to_string(constraint_.getConstraintType()));
    }
  }

 private:
  const KnownBody* find(const btRigidBody& body) const {
    const auto found = bodies_.find(&body);
    return found == bodies_.end() ? nullptr : &found->second;
  }
  static bool may_move(const KnownBody* body) { return body != nullptr && !body->still; }
  void miss(const std::string& what) { ++left_out_[what]; }

  btTransform world(bool a) const {
    const btRigidBody& body = a ? constraint_.getRigidBodyA() : constraint_.getRigidBodyB();
    return bodies_.contains(&body) ? body.getWorldTransform() : btTransform::getIdentity();
  }

  /// In scenes a body that moves comes first.
  bool swapped() const { return !may_move(a_); }

  void put(Json joint, const btVector3& pivot, const std::optional<btVector3>& axis) {
    const KnownBody* const first = swapped() ? b_ : a_;
    const KnownBody* const second = swapped() ? a_ : b_;
    if (collide_) joint["collide"] = true;
    std::optional<std::string> other;
    if (may_move(second)) other = second->name;
    std::optional<Vec3> direction;
    if (axis) direction = vector(*axis);
    out_.add_joint(std::move(joint), first->name, other, vector(pivot), direction);
    if (second != nullptr && second->still && !collide_) out_.exclude(second->name, first->name);
  }

  void add_hinge(btHingeConstraint& hinge) {
    Json joint{{"type", "hinge"}};
    // In scenes, angles are those of the first body as seen from the second, and 0 at the start.
    const double sense = (hinge.getUseReferenceFrameA() ? -1.0 : 1.0) * (swapped() ? -1.0 : 1.0);
    const double now = double{hinge.getHingeAngle(world(true), world(false))};
    if (hinge.hasLimit()) {
      const double low = (double{hinge.getLowerLimit()} - now) * degrees * sense;
      const double high = (double{hinge.getUpperLimit()} - now) * degrees * sense;
      if (std::abs(low) > 180 || std::abs(high) > 180)
        miss("limits of hinges beyond half a turn from where they are");
      else
        joint["limits"] = {std::min(low, high), std::max(low, high)};
    }
    if (hinge.getEnableAngularMotor()) {
      joint["motor"] = {{"speed", sense * double{hinge.getMotorTargetVelocity()}},
                        {"max_force", double{hinge.getMaxMotorImpulse()} / usual_step}};
      out_.note("a motor of a hinge: its strength is taken to be that of steps of 1/60 s");
    }
    const btTransform frame = world(true) * hinge.getAFrame();
    put(std::move(joint), frame.getOrigin(), frame.getBasis().getColumn(2));
  }

  /// Do the frames of both bodies agree?
  static bool agree(const btTransform& a, const btTransform& b) {
    const btScalar close = btScalar(1e-3);
    return a.getOrigin().distance(b.getOrigin()) < close && a.getRotation().angleShortestPath(b.getRotation()) < close;
  }

  void add_cone_twist(const btConeTwistConstraint& cone) {
    const btTransform frame = world(true) * cone.getAFrame();
    if (!agree(frame, world(false) * cone.getBFrame())) miss("bends of cone-twist constraints at the start");
    const double swing1 = double{cone.getSwingSpan1()}, swing2 = double{cone.getSwingSpan2()};
    if (std::abs(swing1 - swing2) > 1e-3) miss("directions of the two swings of cone-twist constraints");
    const auto span = [](double angle) { return std::clamp(angle * degrees, 0.0, 180.0); };
    put({{"type", "cone_twist"},
         {"swing1", span(swing1)},
         {"swing2", span(swing2)},
         {"twist", span(double{cone.getTwistSpan()})}},
        frame.getOrigin(), frame.getBasis().getColumn(0));
  }

  void add_slider(btSliderConstraint& slider) {
    Json joint{{"type", "slider"}};
    const btTransform in_a = world(true) * slider.getFrameOffsetA(), in_b = world(false) * slider.getFrameOffsetB();
    btVector3 axis = in_a.getBasis().getColumn(0);
    // Positions are those of b as seen from a, or the other way round; in scenes, those of the first body.
    const bool b_moves = slider.getUseLinearReferenceFrameA();
    const double now = double{(in_b.getOrigin() - in_a.getOrigin()).dot(axis)} * (b_moves ? 1 : -1);
    const double low = double{slider.getLowerLinLimit()} - now, high = double{slider.getUpperLinLimit()} - now;
    if (low <= high) joint["limits"] = {low, high};
    const bool first_is_a = !swapped();
    if (first_is_a == b_moves) axis = -axis;
    if (slider.getLowerAngLimit() != 0 || slider.getUpperAngLimit() != 0) miss("rotations that sliders allow");
    if (slider.getPoweredLinMotor() || slider.getPoweredAngMotor()) miss("motors of sliders");
    put(std::move(joint), in_b.getOrigin(), axis);
  }

  template <class SixDof>
  void add_six_dof(SixDof& free) {
    const btTransform frame = world(true) * free.getFrameOffsetA();
    if (!agree(frame, world(false) * free.getFrameOffsetB()))
      return miss("6dof constraints that are not in the middle at the start");
    if (has_spring_) miss("springs of 6dof constraints");
    btVector3 limits[4];
    free.getLinearLowerLimit(limits[0]);
    free.getLinearUpperLimit(limits[1]);
    free.getAngularLowerLimit(limits[2]);
    free.getAngularUpperLimit(limits[3]);
    if (std::all_of(limits, limits + 4, [](const btVector3& v) { return v.fuzzyZero(); }))
      return put({{"type", "fixed"}}, frame.getOrigin(), std::nullopt);
    if (!agree(frame, btTransform(btQuaternion::getIdentity(), frame.getOrigin())) || !out_.is_upright())
      return miss("6dof constraints whose axes are not the world's");
    // Bullet has b move as seen from a and a turn as seen from b; scenes have both of the first body seen from the
    // second.
    const bool b_is_first = swapped();
    const auto axes = [&](const btVector3& low, const btVector3& high, double factor, bool as_it_is) {
      Json list = Json::array();
      for (int i = 0; i < 3; ++i) {
        const double l = double{low[i]} * factor, h = double{high[i]} * factor;
        if (l > h)
          list.push_back("free");
        else
          list.push_back(as_it_is ? std::array{l, h} : std::array{-h, -l});
      }
      return list;
    };
    put({{"type", "6dof"},
         {"linear", axes(limits[0], limits[1], 1, b_is_first)},
         {"angular", axes(limits[2], limits[3], degrees, !b_is_first)}},
        frame.getOrigin(), std::nullopt);
  }

  btTypedConstraint& constraint_;
  bool collide_;
  const KnownBodies& bodies_;
  Fragment& out_;
  LeftOut& left_out_;
  const KnownBody* a_ = nullptr;
  const KnownBody* b_ = nullptr;
  bool has_spring_ = false;
};

}  // namespace

void add_constraint(btTypedConstraint& constraint, bool collide, const KnownBodies& bodies, Fragment& out,
                    LeftOut& left_out) {
  Constraint(constraint, collide, bodies, out, left_out).add();
}

}  // namespace boxstream::imports
