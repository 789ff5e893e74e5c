// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/pair_contacts.hpp"

#include <array>
#include <limits>
#include <utility>

#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionShapes/btConcaveShape.h>
#include <BulletCollision/CollisionShapes/btStaticPlaneShape.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>
#include <BulletCollision/CollisionShapes/btTriangleShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

const btConvexShape& convex(const btCollisionObjectWrapper& wrap) {
  return static_cast<const btConvexShape&>(*wrap.getCollisionShape());
}

/// While it lives, a result speaks of a part of one of its two objects.
class SpeaksOfPart {
 public:
  SpeaksOfPart(btManifoldResult& result, const btCollisionObjectWrapper& part, int part_id, int index)
      : result_(result), is_first_(result.getBody0Internal() == part.getCollisionObject()) {
    if (is_first_) {
      former_ = result.getBody0Wrap();
      result.setBody0Wrap(&part);
      result.setShapeIdentifiersA(part_id, index);
    } else {
      former_ = result.getBody1Wrap();
      result.setBody1Wrap(&part);
      result.setShapeIdentifiersB(part_id, index);
    }
  }
  ~SpeaksOfPart() {
    if (is_first_)
      result_.setBody0Wrap(former_);
    else
      result_.setBody1Wrap(former_);
  }
  SpeaksOfPart(const SpeaksOfPart&) = delete;
  SpeaksOfPart& operator=(const SpeaksOfPart&) = delete;

 private:
  btManifoldResult& result_;
  bool is_first_;
  const btCollisionObjectWrapper* former_;
};

}  // namespace

PairContacts::PairContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
                           const btCollisionObjectWrapper* b)
    : btCollisionAlgorithm(info), manifold_(info.m_manifold), owns_(info.m_manifold == nullptr) {
  if (owns_) manifold_ = m_dispatcher->getNewManifold(a->getCollisionObject(), b->getCollisionObject());
}

PairContacts::~PairContacts() {
  if (owns_) m_dispatcher->releaseManifold(manifold_);
}

double PairContacts::reach(const btManifoldResult& result) const {
  return double{manifold_->getContactBreakingThreshold()} + double{result.m_closestPointDistanceThreshold};
}

void PairContacts::add(const ContactPoints& found, const btVector3& origin, bool turned, btManifoldResult& result) {
  result.setPersistentManifold(manifold_);
  const btVector3 normal = vector(found.normal);
  for (std::size_t i = 0; i < found.count; ++i) {
    const auto& [on_b, distance] = found.points[i];
    const auto depth = static_cast<btScalar>(distance);
    const btVector3 at = origin + vector(on_b);
    if (turned)
      result.addContactPoint(-normal, at + normal * depth, depth);
    else
      result.addContactPoint(normal, at, depth);
  }
}

void PairContacts::forget(const ContactPoints* found, std::size_t count, const btVector3& origin, bool turned) {
  if (!owns_) return;
  const btScalar near = manifold_->getContactBreakingThreshold();
  for (int i = manifold_->getNumContacts(); i-- > 0;) {
    const btManifoldPoint& old = manifold_->getContactPoint(i);
    const btVector3& at = turned ? old.getPositionWorldOnA() : old.getPositionWorldOnB();
    bool stays = false;
    for (const ContactPoints* each = found; each != found + count && !stays; ++each)
      for (std::size_t k = 0; k < each->count; ++k)
        stays = stays || at.distance2(origin + vector(each->points[k].on_b)) < near * near;
    if (!stays) manifold_->removeContactPoint(i);
  }
}

void PairContacts::refresh(btManifoldResult& result) {
  result.setPersistentManifold(manifold_);
  if (owns_) result.refreshContactPoints();
}

bool has_slid(const btPersistentManifold& manifold, btScalar share) {
  const btScalar most = share * manifold.getContactBreakingThreshold();
  const btTransform &a = manifold.getBody0()->getWorldTransform(), &b = manifold.getBody1()->getWorldTransform();
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    const btManifoldPoint& point = manifold.getContactPoint(i);
    const btVector3 apart = a * point.m_localPointA - b * point.m_localPointB;
    const btVector3 aside = apart - point.m_normalWorldOnB * point.m_normalWorldOnB.dot(apart);
    if (aside.length2() > most * most) return true;
  }
  return false;
}

void PairContacts::replace(const ContactPoints& found, const btVector3& origin, bool turned, btManifoldResult& result) {
  forget(&found, 1, origin, turned);
  add(found, origin, turned, result);
  refresh(result);
}

void ConvexContacts::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                      const btDispatcherInfo&, btManifoldResult* result) {
  const btVector3& origin = a->getWorldTransform().getOrigin();
  replace(contact_points(PlacedConvex(convex(*a), a->getWorldTransform(), origin),
                         PlacedConvex(convex(*b), b->getWorldTransform(), origin), reach(*result)),
          origin, false, *result);
}

void PlaneContacts::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                     const btDispatcherInfo&, btManifoldResult* result) {
  if (turned_) std::swap(a, b);
  const auto& plane = static_cast<const btStaticPlaneShape&>(*b->getCollisionShape());
  const btTransform& place = b->getWorldTransform();
  const btVector3& origin = a->getWorldTransform().getOrigin();
  const btVector3 up = place.getBasis() * plane.getPlaneNormal();
  Vec3 normal{double{up.x()}, double{up.y()}, double{up.z()}};
  normal = times(normal, 1 / length(normal));
  double offset = double{plane.getPlaneConstant()};
  for (int d = 0; d < 3; ++d)
    offset += normal[static_cast<std::size_t>(d)] * (double{place.getOrigin()[d]} - double{origin[d]});
  replace(contact_points(PlacedConvex(convex(*a), a->getWorldTransform(), origin), normal, offset, reach(*result)),
          origin, turned_, *result);
}

namespace {

/// Contacts with triangles that lie in one plane: they are one face.
struct Sheet {
  std::array<ContactPoints::Point, 32> points;
  std::size_t count = 0;
  Vec3 normal{};
  int part = 0, index = 0;  // of its deepest triangle
  std::array<btVector3, 3> corners;
  double deepest = 0;
};

struct Sheets final : btTriangleCallback {
  Sheets(const PlacedConvex& convex, const btTransform& at, const btVector3& from, btScalar around, double near)
      : solid(convex), place(at), origin(from), margin(around), reach(near) {}

  const PlacedConvex& solid;
  const btTransform& place;  // of the triangles
  const btVector3& origin;
  btScalar margin;
  double reach;
  std::array<Sheet, 8> sheets;
  std::size_t count = 0;

  void processTriangle(btVector3* corners, int part, int index) override {
    btTriangleShape triangle(corners[0], corners[1], corners[2]);
    triangle.setMargin(margin);
    const ContactPoints found = contact_points(solid, PlacedConvex(triangle, place, origin), reach);
    if (found.count == 0) return;
    constexpr double same = 0.9999;  // the cosine of an angle
    std::size_t i = 0;
    while (i < count && dot(sheets[i].normal, found.normal) < same) ++i;
    if (i == sheets.size()) return;
    Sheet& sheet = sheets[i];
    if (i == count) {
      ++count;
      sheet.normal = found.normal;
      sheet.deepest = std::numeric_limits<double>::infinity();
    }
    for (std::size_t k = 0; k < found.count; ++k) {
      if (sheet.count < sheet.points.size()) sheet.points[sheet.count++] = found.points[k];
      if (found.points[k].distance < sheet.deepest) {
        sheet.deepest = found.points[k].distance, sheet.part = part, sheet.index = index;
        sheet.corners = {corners[0], corners[1], corners[2]};
      }
    }
  }
};

}  // namespace

void SurfaceContacts::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                       const btDispatcherInfo&, btManifoldResult* result) {
  if (turned_) std::swap(a, b);
  const auto& surface = static_cast<const btConcaveShape&>(*b->getCollisionShape());
  const btVector3& origin = a->getWorldTransform().getOrigin();
  const PlacedConvex solid(convex(*a), a->getWorldTransform(), origin);
  const double near = reach(*result);

  Sheets sheets(solid, b->getWorldTransform(), origin, surface.getMargin(), near);
  btVector3 low, high;
  a->getCollisionShape()->getAabb(b->getWorldTransform().inverseTimes(a->getWorldTransform()), low, high);
  const auto r = static_cast<btScalar>(near);
  surface.processAllTriangles(&sheets, low - btVector3(r, r, r), high + btVector3(r, r, r));
  std::array<ContactPoints, 8> found;
  for (std::size_t i = 0; i < sheets.count; ++i) {
    found[i].normal = sheets.sheets[i].normal;
    choose_four(sheets.sheets[i].points.data(), sheets.sheets[i].count, found[i]);
  }
  forget(found.data(), sheets.count, origin, false);
  for (std::size_t i = 0; i < sheets.count; ++i) {
    const Sheet& sheet = sheets.sheets[i];
    // Whether its edges are inner ones is asked of its corners.
    btTriangleShape triangle(sheet.corners[0], sheet.corners[1], sheet.corners[2]);
    const btCollisionObjectWrapper wrap(b, &triangle, b->getCollisionObject(), b->getWorldTransform(), sheet.part,
                                        sheet.index);
    const SpeaksOfPart speaks(*result, wrap, sheet.part, sheet.index);
    add(found[i], origin, false, *result);
  }
  refresh(*result);
}

}  // namespace boxstream::scenes
