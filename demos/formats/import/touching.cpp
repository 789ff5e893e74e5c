// SPDX-License-Identifier: MIT
#include "formats/import/touching.hpp"

#include <algorithm>
#include <memory>

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <btBulletCollisionCommon.h>

namespace boxstream::imports {
namespace {

btVector3 bullet_vector(const Vec3& v) {
  return btVector3(static_cast<btScalar>(v[0]), static_cast<btScalar>(v[1]), static_cast<btScalar>(v[2]));
}

btTransform transform(const Frame& f) {
  const auto real = [](double x) { return static_cast<btScalar>(x); };
  return btTransform(btQuaternion(real(f.turn[0]), real(f.turn[1]), real(f.turn[2]), real(f.turn[3])),
                     bullet_vector(f.origin));
}

std::unique_ptr<btConvexShape> touching_hull(const Json& points) {
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Json& point : points) hull->addPoint(bullet_vector(point.get<Vec3>()), false);
  hull->recalcLocalAabb();
  // The margin that worlds of scenes give hulls: of their size, 4 cm at most.
  btVector3 low, high;
  hull->getAabb(btTransform::getIdentity(), low, high);
  const btVector3 size = high - low - btVector3(2, 2, 2) * hull->getMargin();
  hull->setMargin(std::min(hull->getMargin(), btScalar(0.05) * std::min({size.x(), size.y(), size.z()})));
  return hull;
}

std::unique_ptr<btConvexShape> convex(const Json& shape) {
  const auto number = [&](const char* key) { return static_cast<btScalar>(shape.at(key).get<double>()); };
  const std::string type = shape.at("type");
  if (type == "sphere") return std::make_unique<btSphereShape>(number("radius"));
  if (type == "box") return std::make_unique<btBoxShape>(bullet_vector(shape.at("half_extents").get<Vec3>()));
  if (type == "capsule") return std::make_unique<btCapsuleShape>(number("radius"), number("height"));
  if (type == "cylinder")
    return std::make_unique<btCylinderShape>(btVector3(number("radius"), number("height") / 2, number("radius")));
  return touching_hull(shape.at(type == "mesh" ? "vertices" : "points"));
}

struct Convex {
  std::unique_ptr<btConvexShape> shape;
  btTransform place;
  btVector3 low, high;
};

bool overlap(const btVector3& low, const btVector3& high, const Convex& b) {
  for (int d = 0; d < 3; ++d)
    if (low[d] > b.high[d] || b.low[d] > high[d]) return false;
  return true;
}

bool touch(const Convex& a, const Convex& b) {
  constexpr btScalar gap = btScalar(1e-3);
  const btVector3 room(gap, gap, gap);
  if (!overlap(a.low - room, a.high + room, b)) return false;
  btGjkEpaSolver2::sResults results;
  const btVector3 guess = b.place.getOrigin() - a.place.getOrigin();
  if (!btGjkEpaSolver2::Distance(a.shape.get(), a.place, b.shape.get(), b.place, guess, results)) return true;
  return results.distance <= a.shape->getMargin() + b.shape->getMargin() + gap;
}

using Convexes = std::vector<Convex>;

Convexes convexes_of(const Placed& body) {
  Convexes convexes;
  for (const Piece& piece : body.pieces) {
    Convex each{convex(piece.shape), transform(body.place.place(piece.place)), {}, {}};
    each.shape->getAabb(each.place, each.low, each.high);
    convexes.push_back(std::move(each));
  }
  return convexes;
}

bool touch(const Convexes& a, const Convexes& b) {
  return std::any_of(a.begin(), a.end(), [&](const Convex& one) {
    return std::any_of(b.begin(), b.end(), [&](const Convex& other) { return touch(one, other); });
  });
}

}  // namespace

std::vector<std::array<std::size_t, 2>> touching(const std::vector<Placed>& bodies) {
  std::vector<Convexes> convexes;
  for (const Placed& body : bodies) convexes.push_back(convexes_of(body));
  std::vector<std::array<std::size_t, 2>> pairs;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t j = i + 1; j < bodies.size(); ++j)
      if (!(bodies[i].still && bodies[j].still) && touch(convexes[i], convexes[j])) pairs.push_back({i, j});
  return pairs;
}

}  // namespace boxstream::imports
