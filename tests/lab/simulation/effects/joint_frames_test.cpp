// SPDX-License-Identifier: MIT
// Joints of every kind between bodies turned at random against each other. What a joint lets happen is read off the
// motion of its first body as seen from the second, a rigid motion that is nothing at the start whatever the poses are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <btBulletDynamicsCommon.h>

#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using scenes::JointValue;
using scenes::Quat;
using scenes::Scene;
using scenes::Simulation;
using scenes::Vec3;

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Draw {
  explicit Draw(unsigned seed) : engine(seed) {}

  double number(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine()) / static_cast<double>(std::mt19937::max()));
  }
  Vec3 place(double most) { return {number(-most, most), number(-most, most), number(-most, most)}; }
  Quat turn() {
    for (;;) {
      Quat q{number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1)};
      const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      if (length < 0.1 || length > 1) continue;
      for (double& x : q) x /= length;
      return q;
    }
  }
  Vec3 direction() {
    for (;;) {
      Vec3 v = place(1);
      const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      if (length < 0.1 || length > 1) continue;
      for (double& x : v) x /= length;
      return v;
    }
  }

  std::mt19937 engine;
};

btVector3 vector(const Vec3& v) {
  return btVector3(static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2]));
}

/// One bar or two in empty space, turned anyhow, and one joint: body 0 to body 1, or to the world.
struct Pair {
  Pair(unsigned seed, bool to_world) : draw(seed), scene(exhibit("nothing")), with_world(to_world) {
    scene.time.dt = 1.0 / 240;
    scene.world.gravity = {0, 0, 0};
    scene.solver.iterations = 50;
    scene.shapes[0].value = scenes::BoxShape{{0.4, 0.5, 0.6}};
    scene.bodies[0].velocity = {0, 0, 0};
    scene.bodies[0].traits.sleep = false;
    if (!to_world) {
      scene.bodies.push_back(scene.bodies[0]);
      scene.bodies[1].name = "other";
      scene.bodies[1].traits.mass = 4;
    }
    for (scenes::Body& body : scene.bodies) {
      body.position = draw.place(2);
      body.rotation = draw.turn();
    }
    pivot = draw.place(1.5);
    axis = draw.direction();
  }

  void join(JointValue value) {
    scene.joints.clear();
    if (with_world)
      scene.joints.push_back({0, std::nullopt, std::move(value), false});
    else
      scene.joints.push_back({0, 1, std::move(value), false});
  }

  /// Body 0 spins about the pivot, which stays where it is.
  void spin(const btVector3& rate) {
    scenes::Body& body = scene.bodies[0];
    const btVector3 v = rate.cross(vector(body.position) - vector(pivot));
    body.spin = {double{rate.x()}, double{rate.y()}, double{rate.z()}};
    body.velocity = {double{v.x()}, double{v.y()}, double{v.z()}};
  }

  Draw draw;
  Scene scene;
  bool with_world;
  Vec3 pivot{};
  Vec3 axis{};
};

/// The motion of body 0 since the start as seen from what it is joined to, in coordinates of the start.
struct Watch {
  explicit Watch(const Simulation& s) : simulation(s) {
    for (const btCollisionObject* object : s.objects()) start.push_back(object->getWorldTransform());
  }
  btTransform since(std::size_t i) const { return simulation.objects()[i]->getWorldTransform() * start[i].inverse(); }
  btTransform motion() const { return start.size() > 1 ? since(1).inverse() * since(0) : since(0); }
  btVector3 travel(const Vec3& pivot) const { return motion() * vector(pivot) - vector(pivot); }
  /// Axis times angle.
  btVector3 turn() const {
    btQuaternion q = motion().getRotation();
    if (q.w() < 0) q = -q;
    const btVector3 v(q.x(), q.y(), q.z());
    return v.length() < btScalar(1e-9) ? btVector3(0, 0, 0) : v.normalized() * (2 * btAtan2(v.length(), q.w()));
  }

  const Simulation& simulation;
  std::vector<btTransform> start;
};

struct Reach {
  void add(double value) { low = std::min(low, value), high = std::max(high, value), last = value; }
  double low = infinity, high = -infinity, last = 0;
};

class AnyPoses : public testing::TestWithParam<std::tuple<unsigned, bool>> {
 protected:
  // Without the gyroscopic term: what is asked is where joints hold, not how bodies tumble.
  Pair made() const {
    Pair pair(std::get<0>(GetParam()), std::get<1>(GetParam()));
    for (scenes::Body& body : pair.scene.bodies) body.traits.gyro = scenes::Gyro::off;
    return pair;
  }
};

INSTANTIATE_TEST_SUITE_P(Joints, AnyPoses, testing::Combine(testing::Range(1u, 13u), testing::Bool()),
                         [](const auto& drawn) {
                           return std::string(std::get<1>(drawn.param) ? "World" : "Bodies") +
                                  std::to_string(std::get<0>(drawn.param));
                         });

TEST_P(AnyPoses, NothingMovesWithoutACause) {
  Pair pair = made();
  scenes::HingeJoint hinge{pair.pivot, pair.axis, std::array{-0.17, 0.17}, {}};
  scenes::SliderJoint slider{pair.pivot, pair.axis, std::array{-0.1, 0.1}, {}};
  scenes::HingeJoint held_hinge{pair.pivot, pair.axis, std::nullopt, scenes::Motor{0, 100}};
  scenes::SliderJoint held_slider{pair.pivot, pair.axis, std::nullopt, scenes::Motor{0, 100}};
  scenes::SixDofJoint limited{pair.pivot, {}, {}};
  for (auto* axes : {&limited.linear, &limited.angular}) *axes = {{{-0.1, 0.2}, {-0.2, 0.1}, {-0.1, 0.1}}};
  scenes::SixDofJoint locked{pair.pivot, {}, {}};
  const JointValue joints[] = {scenes::BallJoint{pair.pivot},
                               scenes::HingeJoint{pair.pivot, pair.axis, {}, {}},
                               hinge,
                               held_hinge,
                               scenes::SliderJoint{pair.pivot, pair.axis, {}, {}},
                               slider,
                               held_slider,
                               scenes::ConeTwistJoint{pair.pivot, pair.axis, 0.3, 0.4, 0.2},
                               scenes::FixedJoint{pair.pivot},
                               limited,
                               locked,
                               scenes::SpringJoint{pair.pivot, 50, 1}};
  for (const JointValue& value : joints) {
    pair.join(value);
    Simulation simulation(pair.scene, "boxstream");
    double fastest = 0;
    for (int i = 0; i < 60; ++i) {
      simulation.advance();
      fastest = std::max(fastest, simulation.metric(scenes::Check::Metric::max_speed));
    }
    // Rounding of places and frames is what there is to mend, once a step: some units in the last place of a metre.
    EXPECT_LT(fastest, 1e-3) << "kind " << value.index();
  }
}

TEST_P(AnyPoses, AHingeTurnsToItsLimitsAndNotBeyond) {
  Pair pair = made();
  const double low = -pair.draw.number(0.1, 1.2), high = pair.draw.number(0.1, 1.2);
  for (const double speed : {-2.0, 2.0}) {
    pair.join(scenes::HingeJoint{pair.pivot, pair.axis, std::array{low, high}, scenes::Motor{speed, 20}});
    Simulation simulation(pair.scene, "boxstream");
    const Watch watch(simulation);
    Reach reach;
    for (int i = 0; i < 480; ++i) {
      simulation.advance();
      reach.add(double{watch.turn().dot(vector(pair.axis))});
    }
    EXPECT_NEAR(reach.last, speed < 0 ? low : high, 0.02);
    EXPECT_GT(reach.low, low - 0.03);
    EXPECT_LT(reach.high, high + 0.03);
    const btVector3 aside = watch.turn() - vector(pair.axis) * watch.turn().dot(vector(pair.axis));
    EXPECT_LT(double{aside.length()}, 0.01);
    EXPECT_LT(double{watch.travel(pair.pivot).length()}, 0.01);
  }
}

TEST_P(AnyPoses, ASliderMovesToItsLimitsAndNotBeyond) {
  Pair pair = made();
  const double low = -pair.draw.number(0.1, 1.0), high = pair.draw.number(0.1, 1.0);
  for (const double speed : {-1.0, 1.0}) {
    pair.join(scenes::SliderJoint{pair.pivot, pair.axis, std::array{low, high}, scenes::Motor{speed, 20}});
    Simulation simulation(pair.scene, "boxstream");
    const Watch watch(simulation);
    Reach reach;
    for (int i = 0; i < 480; ++i) {
      simulation.advance();
      reach.add(double{watch.travel(pair.pivot).dot(vector(pair.axis))});
    }
    EXPECT_NEAR(reach.last, speed < 0 ? low : high, 0.02);
    EXPECT_GT(reach.low, low - 0.03);
    EXPECT_LT(reach.high, high + 0.03);
    const btVector3 travel = watch.travel(pair.pivot);
    EXPECT_LT(double{(travel - vector(pair.axis) * travel.dot(vector(pair.axis))).length()}, 0.01);
    EXPECT_LT(double{watch.turn().length()}, 0.01);
  }
}

TEST_P(AnyPoses, AMotorWithoutLimitsKeepsItsSpeedAndSign) {
  for (const double speed : {-0.5, 0.5}) {
    Pair pair = made();
    pair.join(scenes::HingeJoint{pair.pivot, pair.axis, {}, scenes::Motor{speed, 200}});
    Simulation turning(pair.scene, "boxstream");
    const Watch turned(turning);
    for (int i = 0; i < 240; ++i) turning.advance();
    EXPECT_NEAR(double{turned.turn().dot(vector(pair.axis))}, speed, 0.03);
    pair.join(scenes::SliderJoint{pair.pivot, pair.axis, {}, scenes::Motor{speed, 200}});
    Simulation moving(pair.scene, "boxstream");
    const Watch moved(moving);
    for (int i = 0; i < 240; ++i) moving.advance();
    EXPECT_NEAR(double{moved.travel(pair.pivot).dot(vector(pair.axis))}, speed, 0.03);
  }
}

TEST_P(AnyPoses, AConeBendsAndTwistsToItsLimits) {
  Pair pair = made();
  constexpr double swing = 0.5, twist = 0.3;
  pair.join(scenes::ConeTwistJoint{pair.pivot, pair.axis, swing, swing, twist});
  const btVector3 axis = vector(pair.axis), aside = axis.cross(vector(pair.draw.direction())).normalized();
  for (const btVector3& spin : {btVector3(axis * 4), btVector3(axis * -4), btVector3(aside * 4)}) {
    pair.spin(spin);
    Simulation simulation(pair.scene, "boxstream");
    const Watch watch(simulation);
    Reach twisted, bent;
    for (int i = 0; i < 240; ++i) {
      simulation.advance();
      twisted.add(std::abs(double{watch.turn().dot(axis)}));
      const btVector3 now = watch.motion().getBasis() * axis;
      bent.add(std::acos(std::clamp(double{now.dot(axis)}, -1.0, 1.0)));
      EXPECT_LT(double{watch.travel(pair.pivot).length()}, 0.05);
    }
    EXPECT_LT(twisted.high, twist + 0.12);
    EXPECT_LT(bent.high, swing + 0.12);
    if (std::abs(spin.dot(axis)) > 1)
      EXPECT_GT(twisted.high, twist * 0.7);
    else
      EXPECT_GT(bent.high, swing * 0.7);
  }
}

TEST_P(AnyPoses, SixDegreesOfFreedomEndAlongTheAxesOfTheWorld) {
  Pair pair = made();
  for (std::size_t d = 0; d < 3; ++d) {
    const double low = -pair.draw.number(0.1, 0.5), high = pair.draw.number(0.1, 0.5);
    for (const bool angular : {false, true}) {
      for (const double sign : {-1.0, 1.0}) {
        scenes::SixDofJoint joint{pair.pivot, {}, {}};
        (angular ? joint.angular : joint.linear)[d] = {low, high};
        pair.join(joint);
        scenes::Body& body = pair.scene.bodies[0];
        body.spin = {0, 0, 0};
        Vec3 motion{};
        motion[d] = sign * 3;
        body.velocity = motion;
        if (angular) pair.spin(vector(motion));
        Simulation simulation(pair.scene, "boxstream");
        const Watch watch(simulation);
        Reach reach;
        for (int i = 0; i < 120; ++i) {
          simulation.advance();
          reach.add(double{(angular ? watch.turn() : watch.travel(pair.pivot))[static_cast<int>(d)]});
        }
        EXPECT_LT(reach.high, high + 0.04) << "axis " << d << (angular ? " angular" : " linear") << " sign " << sign;
        EXPECT_GT(reach.low, low - 0.04) << "axis " << d << (angular ? " angular" : " linear") << " sign " << sign;
        if (sign > 0)
          EXPECT_GT(reach.high, high - 0.04) << "axis " << d << (angular ? " angular" : " linear");
        else
          EXPECT_LT(reach.low, low + 0.04) << "axis " << d << (angular ? " angular" : " linear");
      }
    }
  }
}

TEST_P(AnyPoses, FixedAndBallHoldWhatTheySay) {
  Pair pair = made();
  pair.spin(btVector3(3, 2, 1));
  pair.join(scenes::FixedJoint{pair.pivot});
  Simulation fixed(pair.scene, "boxstream");
  const Watch stiff(fixed);
  pair.join(scenes::BallJoint{pair.pivot});
  Simulation ball(pair.scene, "boxstream");
  const Watch loose(ball);
  Reach turned;
  for (int i = 0; i < 120; ++i) {
    fixed.advance();
    ball.advance();
    EXPECT_LT(double{stiff.turn().length()}, 0.02);
    EXPECT_LT(double{stiff.travel(pair.pivot).length()}, 0.02);
    EXPECT_LT(double{loose.travel(pair.pivot).length()}, 0.02);
    turned.add(double{loose.turn().length()});
  }
  EXPECT_GT(turned.high, 0.3);
}

TEST_P(AnyPoses, ASpringPullsThePivotBackToWhereItWas) {
  Pair pair = made();
  for (scenes::Body& body : pair.scene.bodies) body.position = pair.pivot;  // or it would turn them
  pair.scene.bodies[0].velocity = {1, -1, 0.5};
  pair.join(scenes::SpringJoint{pair.pivot, 40, 6});
  Simulation simulation(pair.scene, "boxstream");
  const Watch watch(simulation);
  Reach away;
  for (int i = 0; i < 240 * 20; ++i) {
    simulation.advance();
    away.add(double{watch.travel(pair.pivot).length()});
  }
  EXPECT_GT(away.high, 0.05);
  EXPECT_LT(away.last, 0.02);
}

}  // namespace
}  // namespace boxstream::effects_test
