// SPDX-License-Identifier: MIT
// Bullet's narrow phase for a pair: the detector that its convex algorithm runs, or the algorithm that its dispatcher
// chooses. Margins of spheres and capsules are their radius and no knob.
#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpaPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkPairDetector.h>
#include <BulletCollision/NarrowPhaseCollision/btMinkowskiPenetrationDepthSolver.h>
#include <BulletCollision/NarrowPhaseCollision/btPointCollector.h>
#include <BulletCollision/NarrowPhaseCollision/btVoronoiSimplexSolver.h>

#include <cmath>
#include <memory>
#include <stdexcept>

#include "narrow_phase/engine.hpp"

namespace boxstream::report::narrow {
namespace {

btVector3 vector_of(const Eigen::Vector3d& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

btTransform transform_of(const RoundedBox& solid) {
  const Eigen::Matrix<btScalar, 3, 3> r = solid.rotation.cast<btScalar>();
  return btTransform(btMatrix3x3(r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)),
                     vector_of(solid.centre));
}

std::unique_ptr<btConvexShape> shape_of(const RoundedBox& solid, bool as_hull, double margin) {
  const auto half = static_cast<btScalar>(solid.half.z()), rounding = static_cast<btScalar>(solid.margin);
  if (solid.margin > 0 && half > 0) return std::make_unique<btCapsuleShapeZ>(rounding, 2 * half);
  if (solid.margin > 0) return std::make_unique<btSphereShape>(rounding);
  std::unique_ptr<btConvexShape> shape;
  if (as_hull) {
    auto hull = std::make_unique<btConvexHullShape>();
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d side(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
      hull->addPoint(vector_of(solid.half.cwiseProduct(side)));
    }
    shape = std::move(hull);
  } else {
    shape = std::make_unique<btBoxShape>(vector_of(solid.half));
  }
  if (!std::isnan(margin)) shape->setMargin(static_cast<btScalar>(margin));
  return shape;
}

struct Pair {
  std::unique_ptr<btConvexShape> a, b;
  btTransform at_a, at_b;
};

std::vector<Pair> pairs_of(std::span<const Pose> poses, bool as_hulls, double margin) {
  std::vector<Pair> pairs;
  for (const Pose& pose : poses)
    pairs.push_back({shape_of(pose.a, as_hulls, margin), shape_of(pose.b, as_hulls, margin), transform_of(pose.a),
                     transform_of(pose.b)});
  return pairs;
}

double answer(Query query, double distance) {
  return query == Query::verdict ? (distance <= 0 ? -1 : 1) : distance;
}

/// The detector of the convex algorithm, with a solver for penetrations.
Engine make_detector(std::shared_ptr<btConvexPenetrationDepthSolver> deep, Query query,
                     std::shared_ptr<std::vector<Pair>> pairs) {
  return [=](std::size_t pose) {
    const Pair& pair = (*pairs)[pose];
    btVoronoiSimplexSolver simplex;
    btGjkPairDetector detector(pair.a.get(), pair.b.get(), &simplex, deep.get());
    btGjkPairDetector::ClosestPointInput input;
    input.m_transformA = pair.at_a;
    input.m_transformB = pair.at_b;
    btPointCollector point;
    detector.getClosestPoints(input, point, nullptr);
    if (!point.m_hasResult) throw std::runtime_error("no result");
    return answer(query, static_cast<double>(point.m_distance));
  };
}

/// What a world does: the algorithm for these two types of shape, and the manifold that it fills.
class Dispatched {
 public:
  Dispatched(Query query, std::shared_ptr<std::vector<Pair>> pairs)
      : query_(query), dispatcher_(&configuration_), pairs_(std::move(pairs)), objects_(2 * pairs_->size()) {
    for (std::size_t i = 0; i < pairs_->size(); ++i) {
      const Pair& pair = (*pairs_)[i];
      objects_[2 * i].setCollisionShape(pair.a.get());
      objects_[2 * i].setWorldTransform(pair.at_a);
      objects_[2 * i + 1].setCollisionShape(pair.b.get());
      objects_[2 * i + 1].setWorldTransform(pair.at_b);
    }
  }

  double ask(std::size_t pose) {
    const btCollisionObject &a = objects_[2 * pose], &b = objects_[2 * pose + 1];
    const btCollisionObjectWrapper wrap_a(nullptr, a.getCollisionShape(), &a, a.getWorldTransform(), -1, -1);
    const btCollisionObjectWrapper wrap_b(nullptr, b.getCollisionShape(), &b, b.getWorldTransform(), -1, -1);
    btCollisionAlgorithm* algorithm = dispatcher_.findAlgorithm(&wrap_a, &wrap_b, nullptr, BT_CONTACT_POINT_ALGORITHMS);
    btManifoldResult result(&wrap_a, &wrap_b);
    const btDispatcherInfo info;
    algorithm->processCollision(&wrap_a, &wrap_b, info, &result);
    btManifoldArray manifolds;
    algorithm->getAllContactManifolds(manifolds);
    double least = std::nan("");
    for (int m = 0; m < manifolds.size(); ++m)
      for (int i = 0; i < manifolds[m]->getNumContacts(); ++i)
        least = std::fmin(least, static_cast<double>(manifolds[m]->getContactPoint(i).getDistance()));
    algorithm->~btCollisionAlgorithm();
    dispatcher_.freeCollisionAlgorithm(algorithm);
    return answer(query_, least);
  }

 private:
  Query query_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  std::shared_ptr<std::vector<Pair>> pairs_;
  std::vector<btCollisionObject> objects_;
};

}  // namespace

Engine make_bullet(const std::string& solver, Query query, const Tuning& tuning, std::span<const Pose> poses) {
  const std::string name = solver.substr(0, solver.find(' '));
  const auto pairs = std::make_shared<std::vector<Pair>>(pairs_of(poses, solver.ends_with(" hulls"), tuning.margin));
  if (name == "dispatcher")
    return [made = std::make_shared<Dispatched>(query, pairs)](std::size_t pose) { return made->ask(pose); };
  if (name == "epa") return make_detector(std::make_shared<btGjkEpaPenetrationDepthSolver>(), query, pairs);
  if (name == "minkowski") return make_detector(std::make_shared<btMinkowskiPenetrationDepthSolver>(), query, pairs);
  throw std::invalid_argument("Bullet has no solver \"" + solver +
                              "\"; there are dispatcher, epa, minkowski, and \"hulls\" behind");
}

}  // namespace boxstream::report::narrow
