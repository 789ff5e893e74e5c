// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <functional>

#include "oracle.hpp"
#include "random_shapes.hpp"

// Answers against formulas, over sizes from 1e-3 to 1e3, near the origin and far from it.
namespace boxstream::ccd_test {
namespace {

constexpr double tolerance = 1e-6;  // the default, as a fraction of the smaller size

struct Place {
  const char* name;
  Vec centre;
};
const Place places[] = {{"origin", {0, 0, 0}}, {"far", {1e6, -3e5, 7e5}}};

/// Compares all three functions with a signed distance (negative: depth).
void check_signed(const ccd::Shape& a, const ccd::Pose& pose_a, const ccd::Shape& b, const ccd::Pose& pose_b,
                  double expected, double allowed, const std::string& what) {
  SCOPED_TRACE(what);
  const ccd::Distance d = distance(a, pose_a, b, pose_b);
  EXPECT_EQ(d.status, ccd::Status::ok);
  EXPECT_NEAR(d.distance, std::max(0.0, expected), allowed);
  EXPECT_LE(d.lower_bound, std::max(0.0, expected) + 0.1 * allowed);
  EXPECT_NEAR((d.on_a - d.on_b).norm(), d.distance, allowed);

  const ccd::Intersection i = intersect(a, pose_a, b, pose_b);
  const ccd::Penetration p = penetration(a, pose_a, b, pose_b);
  EXPECT_EQ(i.status, ccd::Status::ok);
  if (std::abs(expected) > allowed) {
    EXPECT_EQ(i.intersects, expected < 0) << expected;
    EXPECT_EQ(p.intersects, expected < 0) << expected;
  }
  EXPECT_GE(p.depth, std::max(0.0, -expected) - allowed);
  if (p.intersects) {
    EXPECT_NEAR(p.direction.norm(), 1, 1e-12);
    EXPECT_NEAR(p.depth, std::max(0.0, way_out(a, pose_a, b, pose_b, p.direction)), allowed);
  }
  if (p.status == ccd::Status::ok) {
    EXPECT_NEAR(p.depth, std::max(0.0, -expected), allowed) << name(p.method);
  }
}

using SignedDistance = std::function<double(const ccd::Shape&, const ccd::Pose&, const ccd::Shape&, const ccd::Pose&)>;

/// Runs `formula` over random pairs of the two kinds of shapes; at most a share of the depths may be without proof.
void check_kinds(int kind_a, int kind_b, const SignedDistance& formula, double most_inexact = 0.01) {
  int apart = 0, touching = 0, inexact = 0;
  for (const Place& place : places) {
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
      RandomShapes random(seed);
      const double scale = random.size(1e-3, 1e3);
      const ccd::Shape a = random.shape(kind_a, scale), b = random.shape(kind_b, scale * random.size(0.1, 10));
      const ccd::Pose pose_a = random.pose(place.centre, 0), pose_b = random.pose(place.centre, 4 * scale);
      const double expected = formula(a, pose_a, b, pose_b);
      // The formulas themselves see places in the world with 53 bits.
      const double allowed = 2 * tolerance * scale * 2 + 1e-15 * place.centre.norm();
      check_signed(a, pose_a, b, pose_b, expected, allowed, std::string(place.name) + ", seed " + std::to_string(seed));
      ++(expected < 0 ? touching : apart);
      inexact += penetration(a, pose_a, b, pose_b).status != ccd::Status::ok;
    }
  }
  EXPECT_GT(apart, 50);
  EXPECT_GT(touching, 50);
  EXPECT_LE(inexact, most_inexact * touching) << "of " << touching << " depths are upper bounds only";
}

Vec end_of(const ccd::Capsule& capsule, const ccd::Pose& pose, double sign) {
  return pose.translation + pose.rotation.col(2) * (sign * capsule.height / 2);
}

TEST(ClosedForms, SphereSphere) {
  check_kinds(1, 1, [](const auto& a, const auto& p, const auto& b, const auto& q) {
    return (p.translation - q.translation).norm() - std::get<ccd::Sphere>(a).radius - std::get<ccd::Sphere>(b).radius;
  });
}

TEST(ClosedForms, SphereCapsule) {
  check_kinds(1, 2, [](const auto& a, const auto& p, const auto& b, const auto& q) {
    const auto& capsule = std::get<ccd::Capsule>(b);
    return segment_distance(p.translation, p.translation, end_of(capsule, q, -1), end_of(capsule, q, 1)) -
           std::get<ccd::Sphere>(a).radius - capsule.radius;
  });
}

TEST(ClosedForms, CapsuleCapsule) {
  check_kinds(2, 2, [](const auto& a, const auto& p, const auto& b, const auto& q) {
    const auto &x = std::get<ccd::Capsule>(a), &y = std::get<ccd::Capsule>(b);
    return segment_distance(end_of(x, p, -1), end_of(x, p, 1), end_of(y, q, -1), end_of(y, q, 1)) - x.radius - y.radius;
  });
}

TEST(ClosedForms, SphereBox) {
  check_kinds(1, 0, [](const auto& a, const auto& p, const auto& b, const auto& q) {
    return point_to_box(p.translation, std::get<ccd::Box>(b), q) - std::get<ccd::Sphere>(a).radius;
  });
}

TEST(ClosedForms, SphereCylinder) {
  check_kinds(
      1, 3,
      [](const auto& a, const auto& p, const auto& b, const auto& q) {
        return point_to_cylinder(p.translation, std::get<ccd::Cylinder>(b), q) - std::get<ccd::Sphere>(a).radius;
      },
      0.06);
}

TEST(ClosedForms, ConeSphere) {
  check_kinds(4, 1, [](const auto& a, const auto& p, const auto& b, const auto& q) {
    return point_to_cone(q.translation, std::get<ccd::Cone>(a), p) - std::get<ccd::Sphere>(b).radius;
  });
}

/// Depths of shapes with flat faces against every direction that can matter; gaps against "no direction parts them".
void check_flat(int kind_a, int kind_b, double least_share_ok) {
  int deep = 0, ok = 0;
  for (const Place& place : places) {
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      RandomShapes random(seed);
      const double scale = random.size(1e-3, 1e3);
      const ccd::Shape a = random.shape(kind_a, scale), b = random.shape(kind_b, scale);
      const ccd::Pose pose_a = random.pose(place.centre, 0), pose_b = random.pose(place.centre, 2 * scale);
      const double expected = least_way_out(a, pose_a, b, pose_b);
      const double allowed = 4 * tolerance * scale;
      SCOPED_TRACE(std::string(place.name) + ", seed " + std::to_string(seed));
      if (std::abs(expected) < allowed) continue;
      EXPECT_EQ(intersect(a, pose_a, b, pose_b).intersects, expected > 0);
      EXPECT_EQ(distance(a, pose_a, b, pose_b).distance == 0, expected > 0);
      const ccd::Penetration p = penetration(a, pose_a, b, pose_b);
      ASSERT_EQ(p.intersects, expected > 0);
      if (!p.intersects) continue;
      ++deep;
      EXPECT_NEAR(p.depth, way_out(a, pose_a, b, pose_b, p.direction), 1e-9 * scale);
      EXPECT_GE(p.depth, expected - 1e-9 * scale);
      if (p.status != ccd::Status::ok) continue;
      ++ok;
      EXPECT_NEAR(p.depth, expected, allowed) << name(p.method);
      EXPECT_NEAR((p.on_a - p.on_b).dot(p.direction), p.depth, allowed);
    }
  }
  EXPECT_GT(deep, 60);
  EXPECT_GE(ok, least_share_ok * deep);
}

TEST(FlatFaces, BoxBox) {
  check_flat(0, 0, 1);
}
TEST(FlatFaces, BoxHull) {
  check_flat(0, 5, 0.98);
}
TEST(FlatFaces, HullHull) {
  check_flat(5, 5, 0.98);
}

/// Overlaps of 1e-13 to 1e-2, where EPA starts beside the origin more often than not.
TEST(FlatFaces, BarelyTouching) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    RandomShapes random(seed);
    const ccd::Shape a = random.shape(seed % 2 == 0 ? 0 : 5, 1), b = random.shape(seed % 3 == 0 ? 0 : 5, 1);
    const ccd::Pose pose_a = random.pose(Vec::Zero(), 0);
    ccd::Pose pose_b = random.pose(Vec::Zero(), 0);
    const Vec direction = random.direction();
    double inside = 0, outside = 20;
    for (int i = 0; i < 60; ++i) {
      const double middle = (inside + outside) / 2;
      pose_b.translation = direction * middle;
      (distance(a, pose_a, b, pose_b).distance > 0 ? outside : inside) = middle;
    }
    pose_b.translation = direction * (inside - std::pow(10, -2 - static_cast<int>(seed % 12)));
    const double expected = least_way_out(a, pose_a, b, pose_b);
    const ccd::Penetration p = penetration(a, pose_a, b, pose_b);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", overlap " << expected << ", by " << name(p.method));
    EXPECT_TRUE(p.intersects || expected < 1e-12);
    EXPECT_TRUE(intersect(a, pose_a, b, pose_b).intersects || expected < 1e-12);
    EXPECT_EQ(p.status, ccd::Status::ok);
    EXPECT_NEAR(p.depth, std::max(0.0, expected), 3e-6);
    // libccd's EPA is sure of depths here that are far too large.
    ccd::Options by_gjk;
    by_gjk.solver = ccd::Options::Solver::gjk;
    const ccd::Penetration q = penetration(a, pose_a, b, pose_b, by_gjk);
    EXPECT_TRUE(q.status != ccd::Status::ok || q.depth <= std::max(0.0, expected) + 3e-6) << q.depth;
  }
}

/// Where no formula is at hand: the depth is a way out, a search finds no shorter one, and moving B along it by that
/// much and a little more parts the shapes.
TEST(CurvedShapes, NoShorterWayOutIsFound) {
  int deep = 0, ok = 0;
  for (int kind_a = 0; kind_a < RandomShapes::kinds; ++kind_a) {
    for (int kind_b = kind_a; kind_b < RandomShapes::kinds; ++kind_b) {
      for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        RandomShapes random(seed);
        const double scale = random.size(1e-3, 1e3);
        const ccd::Shape a = random.shape(kind_a, scale), b = random.shape(kind_b, scale);
        const ccd::Pose pose_a = random.pose(Vec::Zero(), scale), pose_b = random.pose(Vec::Zero(), scale);
        const ccd::Penetration p = penetration(a, pose_a, b, pose_b);
        SCOPED_TRACE(testing::Message() << "kinds " << kind_a << ' ' << kind_b << ", seed " << seed);
        ASSERT_NE(p.status, ccd::Status::invalid_input);
        if (!p.intersects) continue;
        ++deep;
        EXPECT_NEAR(p.depth, way_out(a, pose_a, b, pose_b, p.direction), 1e-9 * scale);
        ccd::Pose moved = pose_b;
        moved.translation += p.direction * (p.depth + 1e-3 * scale);
        EXPECT_FALSE(intersect(a, pose_a, b, moved).intersects);
        if (p.status != ccd::Status::ok) continue;
        ++ok;
        EXPECT_LE(p.depth, searched_way_out(a, pose_a, b, pose_b, random) + 2e-6 * scale) << name(p.method);
        moved.translation -= p.direction * (2e-3 * scale);
        if (p.depth > 2e-3 * scale) {
          EXPECT_TRUE(intersect(a, pose_a, b, moved).intersects);
        }
      }
    }
  }
  EXPECT_GT(deep, 400);
  EXPECT_GE(ok, 0.98 * deep);
}

TEST(Symmetry, SwappedShapesGiveTheSameDepth) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    RandomShapes random(seed);
    const ccd::Shape a = random.shape(static_cast<int>(seed % 6), 1),
                     b = random.shape(static_cast<int>(seed / 6 % 6), 1);
    const ccd::Pose pose_a = random.pose(Vec::Zero(), 1), pose_b = random.pose(Vec::Zero(), 1);
    const ccd::Penetration p = penetration(a, pose_a, b, pose_b), q = penetration(b, pose_b, a, pose_a);
    EXPECT_EQ(p.intersects, q.intersects) << "seed " << seed;
    if (p.status == ccd::Status::ok && q.status == ccd::Status::ok) {
      EXPECT_NEAR(p.depth, q.depth, 4e-6) << "seed " << seed;
    }
    EXPECT_NEAR(distance(a, pose_a, b, pose_b).distance, distance(b, pose_b, a, pose_a).distance, 4e-6);
  }
}

}  // namespace
}  // namespace boxstream::ccd_test
