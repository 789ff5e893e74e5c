// SPDX-License-Identifier: MIT
// How far apart two shapes are, and where they touch, against what is known of balls, boxes and planes.
#include "simulation/engine/contacts/contact_points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <btBulletCollisionCommon.h>

#include "simulation/engine/cone.hpp"
#include "simulation/engine/contacts/separation.hpp"

namespace boxstream::scenes {
namespace {

std::mt19937 random_bits(5);

float random_between(double low, double high) {
  return static_cast<float>(std::uniform_real_distribution<double>(low, high)(random_bits));
}

btQuaternion random_turn(double most) {
  const auto x = [&] { return random_between(-1, 1); };
  return btQuaternion(btVector3(x(), x(), x()).normalized(), random_between(-most, most));
}

btTransform at(float x, float y, float z, const btQuaternion& turn = btQuaternion::getIdentity()) {
  return btTransform(turn, btVector3(x, y, z));
}

Separation between(const btConvexShape& a, const btTransform& at_a, const btConvexShape& b, const btTransform& at_b,
                   double reach) {
  const btVector3& origin = at_a.getOrigin();
  return separation(PlacedConvex(a, at_a, origin), PlacedConvex(b, at_b, origin), reach);
}

/// In floats, as transforms are: good for five digits. The signed distance of a point from a box around the origin:
/// from its surface outside, and to its nearest face within.
double from_box(const btVector3& half, const btVector3& point) {
  double outside = 0, inside = -1e30;
  for (int d = 0; d < 3; ++d) {
    const double beyond = std::abs(double{point[d]}) - half[d];
    outside += std::pow(std::max(beyond, 0.0), 2);
    inside = std::max(inside, beyond);
  }
  return inside > 0 ? std::sqrt(outside) : inside;
}

TEST(Separations, OfABallAndABox) {
  for (int round = 0; round < 3000; ++round) {
    const double size = std::pow(10.0, random_between(-3, 2));
    const auto long_by = [&](double low, double high) { return random_between(low * size, high * size); };
    const btVector3 half(long_by(0.1, 1), long_by(0.1, 1), long_by(0.1, 1));
    const btBoxShape box(half);
    const btSphereShape ball(long_by(0.05, 0.5));
    const btTransform of_box = at(long_by(-1, 1), long_by(-1, 1), long_by(-1, 1), random_turn(3));
    const btTransform of_ball = at(long_by(-2, 2), long_by(-2, 2), long_by(-2, 2));
    const double truth = from_box(half, of_box.invXform(of_ball.getOrigin())) - double{ball.getRadius()};
    const Separation found = between(ball, of_ball, box, of_box, 1e9);
    EXPECT_NEAR(found.distance, truth, 1e-5 * size);
    EXPECT_NEAR(length(found.normal), 1, 1e-9);
    // Reported from the other side, it is the same the other way round.
    const Separation turned = between(box, of_box, ball, of_ball, 1e9);
    EXPECT_NEAR(turned.distance, truth, 1e-5 * size);
  }
}

// By the separating axes of two boxes: the largest distance along any is the truth where they overlap, and not more
// than that where they are apart.
double along_axes(const btVector3& a, const btTransform& at_a, const btVector3& b, const btTransform& at_b) {
  const auto reach = [](const btVector3& half, const btTransform& place, const btVector3& axis) {
    double sum = 0;
    for (int d = 0; d < 3; ++d) sum += double{half[d]} * std::abs(double{place.getBasis().getColumn(d).dot(axis)});
    return sum;
  };
  double most = -1e30;
  const auto take = [&](btVector3 axis) {
    if (axis.length() < 1e-3f) return;
    axis.normalize();
    const double apart = std::abs(double{(at_a.getOrigin() - at_b.getOrigin()).dot(axis)});
    most = std::max(most, apart - reach(a, at_a, axis) - reach(b, at_b, axis));
  };
  for (int i = 0; i < 3; ++i) {
    take(at_a.getBasis().getColumn(i));
    take(at_b.getBasis().getColumn(i));
    for (int k = 0; k < 3; ++k) take(at_a.getBasis().getColumn(i).cross(at_b.getBasis().getColumn(k)));
  }
  return most;
}

TEST(Separations, OfTwoBoxes) {
  int overlapping = 0;
  for (int round = 0; round < 3000; ++round) {
    const double size = std::pow(10.0, random_between(-3, 2));
    const auto long_by = [&](double low, double high) { return random_between(low * size, high * size); };
    const btVector3 a(long_by(0.1, 1), long_by(0.1, 1), long_by(0.1, 1)),
        b(long_by(0.1, 1), long_by(0.1, 1), long_by(0.1, 1));
    const btTransform at_a = at(long_by(-1, 1), long_by(-1, 1), long_by(-1, 1), random_turn(3));
    const btTransform at_b = at(long_by(-1, 1), long_by(-1, 1), long_by(-1, 1), random_turn(3));
    const double truth = along_axes(a, at_a, b, at_b);
    const Separation found = between(btBoxShape(a), at_a, btBoxShape(b), at_b, 1e9);
    if (truth < 0) {
      EXPECT_NEAR(found.distance, truth, 1e-5 * size);
      ++overlapping;
    } else {
      EXPECT_GE(found.distance, truth - 1e-5 * size);
    }
  }
  EXPECT_GT(overlapping, 500);
}

// A crumb on a large table, with gaps and slopes that rounding makes: there, nothing is lost.
TEST(Separations, OfSmallOnLarge) {
  const btBoxShape table(btVector3(10, 1, 10));
  const btTransform below = at(0, -1, 0);
  for (const float half : {0.0005f, 0.005f, 0.05f}) {
    const btBoxShape crumb(btVector3(half, half / 5, half));
    for (int round = 0; round < 3000; ++round) {
      const btTransform place = at(random_between(-1e-6, 1e-6), half / 5 + random_between(-1e-8, 1e-8),
                                   random_between(-1e-6, 1e-6), random_turn(1e-6));
      for (const bool turned : {false, true}) {
        const Separation found = turned ? between(table, below, crumb, place, 1e-3 * half)
                                        : between(crumb, place, table, below, 1e-3 * half);
        EXPECT_LT(std::abs(found.distance), 1.5e-6 * half + 2e-8);
        EXPECT_GT(found.normal[1] * (turned ? -1 : 1), 0.999);
      }
    }
  }
}

TEST(ContactPoints, OfFacesAreTheirCorners) {
  const btBoxShape box(btVector3(0.3f, 0.2f, 0.1f)), table(btVector3(2, 1, 2));
  const btTransform place = at(0.5f, 0.2f, 0.25f, btQuaternion(btVector3(0, 1, 0), 0.4f)), below = at(0, -1, 0);
  const ContactPoints found =
      contact_points(PlacedConvex(box, place, place.getOrigin()), PlacedConvex(table, below, place.getOrigin()), 0.01);
  ASSERT_EQ(found.count, 4u);
  EXPECT_NEAR(found.normal[1], 1, 1e-6);
  double x = 0, z = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3& at = found.points[i].on_b;
    EXPECT_NEAR(found.points[i].distance, 0, 1e-7);
    EXPECT_NEAR(at[1], -0.2, 1e-7);
    EXPECT_NEAR(std::hypot(at[0], at[2]), std::hypot(0.3, 0.1), 1e-6);
    x += at[0], z += at[2];
  }
  EXPECT_NEAR(x, 0, 1e-6);
  EXPECT_NEAR(z, 0, 1e-6);
}

TEST(ContactPoints, OfWhatHangsOverAnEdgeAreOnTheTable) {
  const btBoxShape box(btVector3(0.3f, 0.1f, 0.1f)), table(btVector3(1, 1, 1));
  const btTransform place = at(1, 0.1f, 0), below = at(0, -1, 0);
  const ContactPoints found =
      contact_points(PlacedConvex(box, place, place.getOrigin()), PlacedConvex(table, below, place.getOrigin()), 0.01);
  ASSERT_EQ(found.count, 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_LT(found.points[i].on_b[0], 1e-6);
    EXPECT_GT(found.points[i].on_b[0], -0.3 - 1e-6);
  }
}

TEST(ContactPoints, OfACylinderThatLiesAreTheEndsOfItsLine) {
  const btCylinderShape cylinder(btVector3(0.2f, 0.5f, 0.2f));
  const btTransform place = at(0, 0.2f, 0, btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI));
  const ContactPoints on_plane =
      contact_points(PlacedConvex(cylinder, place, place.getOrigin()), {0, 1, 0}, -0.2, 0.01);
  ASSERT_EQ(on_plane.count, 2u);
  EXPECT_NEAR(std::abs(on_plane.points[0].on_b[0] - on_plane.points[1].on_b[0]), 1, 1e-5);
  const btCylinderShape log(btVector3(0.4f, 0.3f, 0.4f));
  const btTransform below = at(0.1f, -0.4f, 0, btQuaternion(btVector3(0, 0, 1), SIMD_HALF_PI));
  const ContactPoints on_log = contact_points(PlacedConvex(cylinder, place, place.getOrigin()),
                                              PlacedConvex(log, below, place.getOrigin()), 0.01);
  ASSERT_EQ(on_log.count, 2u);
  EXPECT_NEAR(std::abs(on_log.points[0].on_b[0] - on_log.points[1].on_b[0]), 0.6, 1e-3);
}

TEST(ContactPoints, ThereAreNoneBeyondReach) {
  const btBoxShape box(btVector3(0.5f, 0.5f, 0.5f));
  const btTransform a = at(0, 0, 0), b = at(1.02f, 0, 0);
  EXPECT_EQ(contact_points(PlacedConvex(box, a, a.getOrigin()), PlacedConvex(box, b, a.getOrigin()), 0.01).count, 0u);
  EXPECT_EQ(contact_points(PlacedConvex(box, a, a.getOrigin()), PlacedConvex(box, b, a.getOrigin()), 0.03).count, 4u);
}

}  // namespace
}  // namespace boxstream::scenes
