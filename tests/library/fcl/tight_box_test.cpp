// SPDX-License-Identifier: MIT
// The box source that follows the rotation of objects.
#include <cmath>

#include <boxstream/fcl/tight_box.hpp>

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/plane.h>
#include <fcl/math/bv/OBBRSS.h>

#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

using boxstream::fcl::tightBox;

template <class S>
struct TightBox : ::testing::Test {};
TYPED_TEST_SUITE(TightBox, Scalars);

/// Points on the surface of a shape, in its own frame.
template <class S>
std::vector<::fcl::Vector3<S>> surface(const ::fcl::CollisionGeometry<S>& geometry) {
  std::vector<::fcl::Vector3<S>> points;
  const ::fcl::Vector3<S> half = (geometry.aabb_local.max_ - geometry.aabb_local.min_) / 2;
  const ::fcl::Vector3<S> middle = (geometry.aabb_local.max_ + geometry.aabb_local.min_) / 2;
  const ::fcl::NODE_TYPE type = geometry.getNodeType();
  if (const auto* const mesh = dynamic_cast<const ::fcl::BVHModel<::fcl::OBBRSS<S>>*>(&geometry))
    return {mesh->vertices, mesh->vertices + mesh->num_vertices};
  for (int i = 0; i <= 32; ++i)
    for (int j = 0; j < 32; ++j) {
      const S up = std::acos(S(-1)) * S(i) / 32, round = std::acos(S(-1)) * S(j) / 16;
      ::fcl::Vector3<S> p(std::sin(up) * std::cos(round), std::sin(up) * std::sin(round), std::cos(up));
      if (type == ::fcl::GEOM_SPHERE || type == ::fcl::GEOM_ELLIPSOID) {
        p = p.cwiseProduct(half);
      } else if (type == ::fcl::GEOM_CAPSULE) {
        p *= half[0];
        p[2] += std::copysign(half[2] - half[0], p[2]);
      } else if (type == ::fcl::GEOM_CYLINDER) {
        p = ::fcl::Vector3<S>(std::cos(round) * half[0], std::sin(round) * half[1], i % 2 == 0 ? half[2] : -half[2]);
      } else {  // corners
        p = ::fcl::Vector3<S>(i & 1 ? half[0] : -half[0], i & 2 ? half[1] : -half[1], i & 4 ? half[2] : -half[2]);
      }
      points.push_back(p + middle);
    }
  return points;
}

TYPED_TEST(TightBox, ContainsTheShapeAndIsNoLargerThanTheCube) {
  using S = TypeParam;
  const auto mesh = std::make_shared<::fcl::BVHModel<::fcl::OBBRSS<S>>>();
  mesh->beginModel();
  mesh->addTriangle(::fcl::Vector3<S>(1, 1, 1), ::fcl::Vector3<S>(4, 1, 2), ::fcl::Vector3<S>(2, 3, 1));
  mesh->addTriangle(::fcl::Vector3<S>(1, 1, 1), ::fcl::Vector3<S>(4, 1, 2), ::fcl::Vector3<S>(2, 2, 9));
  mesh->endModel();
  const auto octahedron = std::make_shared<::fcl::BVHModel<::fcl::OBBRSS<S>>>();  // the corners of its box are far out
  octahedron->beginModel();
  for (int i = 0; i < 8; ++i)
    octahedron->addTriangle(::fcl::Vector3<S>(i & 1 ? 1 : -1, 0, 0), ::fcl::Vector3<S>(0, i & 2 ? 1 : -1, 0),
                            ::fcl::Vector3<S>(0, 0, i & 4 ? 1 : -1));
  octahedron->endModel();
  const std::vector<std::shared_ptr<::fcl::CollisionGeometry<S>>> geometries = {
      std::make_shared<::fcl::Box<S>>(S(0.1), S(0.2), S(3)),
      std::make_shared<::fcl::Sphere<S>>(S(0.7)),
      std::make_shared<::fcl::Ellipsoid<S>>(S(0.3), S(0.5), S(2)),
      std::make_shared<::fcl::Capsule<S>>(S(0.2), S(3)),
      std::make_shared<::fcl::Cylinder<S>>(S(0.2), S(3)),
      mesh,
      octahedron};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> u(-1, 1);
  for (const auto& geometry : geometries) {
    Object<S> object(geometry);
    double cubes = 0, tight = 0;
    for (int turn = 0; turn < 60; ++turn) {
      const ::fcl::Quaternion<S> q =
          ::fcl::Quaternion<S>(S(u(random)), S(u(random)), S(u(random)), S(u(random))).normalized();
      object.setTransform(q, ::fcl::Vector3<S>(S(10 * u(random)), S(10 * u(random)), S(10 * u(random))));
      object.computeAABB();
      const FclBox<S> box = tightBox<S>(object), around = object.getAABB();
      const S rounding = 64 * std::numeric_limits<S>::epsilon() * 16;
      for (int d = 0; d < 3; ++d) {
        ASSERT_GE(box.min_[d], around.min_[d] - rounding) << "type " << geometry->getNodeType();
        ASSERT_LE(box.max_[d], around.max_[d] + rounding) << "type " << geometry->getNodeType();
      }
      for (const ::fcl::Vector3<S>& point : surface<S>(*geometry)) {
        const ::fcl::Vector3<S> p = object.getTransform() * point;
        ASSERT_TRUE((box.min_.array() <= p.array() + rounding / 64).all() &&
                    (p.array() - rounding / 64 <= box.max_.array()).all())
            << "type " << geometry->getNodeType();
      }
      cubes += static_cast<double>(around.volume());
      tight += static_cast<double>(box.volume());
    }
    const bool is_round = geometry->getNodeType() == ::fcl::GEOM_SPHERE || geometry == octahedron;
    EXPECT_LT(tight, (is_round ? 1.001 : 0.7) * cubes) << "type " << geometry->getNodeType();
  }
}

TYPED_TEST(TightBox, OfWhatHasNoEndsIsWhatFclSays) {
  using S = TypeParam;
  using Vector = ::fcl::Vector3<S>;
  const std::shared_ptr<::fcl::CollisionGeometry<S>> geometries[] = {
    std::make_shared<::fcl::Halfspace<S>>(Vector::UnitY(), S(1)),
    std::make_shared<::fcl::Plane<S>>(Vector::UnitX(), S(2)),
#if FCL_HAVE_OCTOMAP
    std::make_shared<::fcl::OcTree<S>>(S(0.25)),
#endif
  };
  for (const auto& geometry : geometries) {
    Object<S> object(geometry, ::fcl::AngleAxis<S>(S(0.3), Vector::UnitZ()).toRotationMatrix(), Vector(1, 2, 3));
    object.computeAABB();
    const ::fcl::AABB<S> box = tightBox(object), is = object.getAABB();
    EXPECT_EQ(box.min_, is.min_);
    EXPECT_EQ(box.max_, is.max_);
  }
}

TYPED_TEST(TightBox, AsTheSourceOfAManager) {
  using S = TypeParam;
  // Two long links side by side, both turned.
  const auto link = std::make_shared<::fcl::Capsule<S>>(S(0.05), S(2));
  const ::fcl::Matrix3<S> turned = ::fcl::AngleAxis<S>(S(0.5), ::fcl::Vector3<S>::UnitX()).toRotationMatrix();
  Object<S> a(link, turned, ::fcl::Vector3<S>(0, 0, 0)), b(link, turned, ::fcl::Vector3<S>(S(0.5), 0, 0));
  Manager<S> manager;
  const auto count = [](Object<S>*, Object<S>*, void* data) {
    ++*static_cast<std::size_t*>(data);
    return false;
  };
  for (const bool tight : {false, true}) {
    manager.setBoxSource(tight ? tightBox<S> : nullptr);
    a.computeAABB();
    b.computeAABB();
    manager.registerObjects({&a, &b});
    manager.update();
    std::size_t calls = 0;
    manager.collide(&calls, count);
    manager.collide(&b, &calls, count);
    EXPECT_EQ(calls, tight ? 0U : 2U);
  }
}

TYPED_TEST(TightBox, OfAMeshWithoutVerticesIsEmpty) {
  using S = TypeParam;
  Object<S> object(std::make_shared<::fcl::BVHModel<::fcl::OBBRSS<S>>>());
  for (const S turn : {S(0), S(1)}) {
    object.setTransform(::fcl::Quaternion<S>(1, turn, 0, 0).normalized(), ::fcl::Vector3<S>(1, 2, 3));
    const FclBox<S> box = tightBox<S>(object);
    for (int d = 0; d < 3; ++d) EXPECT_GT(box.min_[d], box.max_[d]);
  }
}

}  // namespace
}  // namespace boxstream::fcl_test
