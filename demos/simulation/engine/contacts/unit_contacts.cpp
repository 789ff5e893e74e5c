// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/unit_contacts.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btCollisionAlgorithm.h>
#include <BulletCollision/BroadphaseCollision/btDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>
#include <BulletCollision/CollisionDispatch/btCollisionObjectWrapper.h>
#include <BulletCollision/CollisionDispatch/btManifoldResult.h>
#include <BulletCollision/CollisionShapes/btCompoundShape.h>
#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <LinearMath/btAabbUtil2.h>

#include "simulation/engine/contacts/pair_contacts.hpp"
#include "simulation/engine/contacts/sliding_contacts.hpp"

namespace boxstream::scenes {
namespace {

/// Contacts of a compound, part by part. Bullet's own algorithm drops those of a part as soon as its box does not touch
/// the other's, however near the two are, and all contacts begin anew. `turned`: the compound comes second.
class PartContacts final : public btCollisionAlgorithm {
 public:
  PartContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
               const btCollisionObjectWrapper* b, bool turned);
  ~PartContacts() override;

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override;
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override;

 private:
  void drop(btCollisionAlgorithm*& part);

  std::vector<btCollisionAlgorithm*> parts_;  // null where a part is not near
  btPersistentManifold* shared_;
  bool turned_;
};

PartContacts::PartContacts(const btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper*,
                           const btCollisionObjectWrapper*, bool turned)
    : btCollisionAlgorithm(info), shared_(info.m_manifold), turned_(turned) {}

PartContacts::~PartContacts() {
  for (btCollisionAlgorithm*& part : parts_) drop(part);
}

void PartContacts::drop(btCollisionAlgorithm*& part) {
  if (part == nullptr) return;
  part->~btCollisionAlgorithm();
  m_dispatcher->freeCollisionAlgorithm(part);
  part = nullptr;
}

void PartContacts::getAllContactManifolds(btManifoldArray& manifolds) {
  for (btCollisionAlgorithm* const part : parts_)
    if (part != nullptr) part->getAllContactManifolds(manifolds);
}

void PartContacts::processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                                    const btDispatcherInfo& info, btManifoldResult* result) {
  if (turned_) std::swap(a, b);
  const auto& compound = static_cast<const btCompoundShape&>(*a->getCollisionShape());
  parts_.resize(static_cast<std::size_t>(compound.getNumChildShapes()));
  const auto reach_of = [](const btCollisionObjectWrapper& wrap) {
    return wrap.getCollisionShape()->getContactBreakingThreshold(gContactBreakingThreshold);
  };
  const btScalar reach = std::min(reach_of(*a), reach_of(*b)) + result->m_closestPointDistanceThreshold;
  const btVector3 margin(reach, reach, reach);
  btVector3 other_low, other_high;
  b->getCollisionShape()->getAabb(b->getWorldTransform(), other_low, other_high);
  for (int i = 0; i < compound.getNumChildShapes(); ++i) {
    btCollisionAlgorithm*& part = parts_[static_cast<std::size_t>(i)];
    const btCollisionShape* const shape = compound.getChildShape(i);
    const btTransform place = a->getWorldTransform() * compound.getChildTransform(i);
    btVector3 low, high;
    shape->getAabb(place, low, high);
    if (!TestAabbAgainstAabb2(low - margin, high + margin, other_low, other_high)) {
      drop(part);
      continue;
    }
    const btCollisionObjectWrapper wrap(a, shape, a->getCollisionObject(), place, -1, i);
    if (part == nullptr) part = m_dispatcher->findAlgorithm(&wrap, b, shared_, BT_CONTACT_POINT_ALGORITHMS);
    const bool is_first = result->getBody0Internal() == a->getCollisionObject();
    const btCollisionObjectWrapper* const former = is_first ? result->getBody0Wrap() : result->getBody1Wrap();
    if (is_first) {
      result->setBody0Wrap(&wrap);
      result->setShapeIdentifiersA(-1, i);
    } else {
      result->setBody1Wrap(&wrap);
      result->setShapeIdentifiersB(-1, i);
    }
    part->processCollision(&wrap, b, info, result);
    if (is_first)
      result->setBody0Wrap(former);
    else
      result->setBody1Wrap(former);
  }
}

/// An algorithm of ours where one of the two is marked, and the former one otherwise.
template <class Algorithm, class... More>
class Make final : public btCollisionAlgorithmCreateFunc {
 public:
  explicit Make(btCollisionAlgorithmCreateFunc* former, More... more) : former_(former), arguments_(more...) {}

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* a,
                                                 const btCollisionObjectWrapper* b) override {
    if (!UnitContacts::is_marked(*a->getCollisionObject()) && !UnitContacts::is_marked(*b->getCollisionObject()))
      return former_->CreateCollisionAlgorithm(info, a, b);
    void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Algorithm));
    return std::apply([&](More... more) { return new (place) Algorithm(info, a, b, more...); }, arguments_);
  }

 private:
  btCollisionAlgorithmCreateFunc* former_;
  std::tuple<More...> arguments_;
};

constexpr std::array<int, 7> convex_types{
    BOX_SHAPE_PROXYTYPE,      SPHERE_SHAPE_PROXYTYPE,      CAPSULE_SHAPE_PROXYTYPE, CYLINDER_SHAPE_PROXYTYPE,
    CUSTOM_CONVEX_SHAPE_TYPE, CONVEX_HULL_SHAPE_PROXYTYPE, TRIANGLE_SHAPE_PROXYTYPE};
constexpr std::array<int, 2> surface_types{TRIANGLE_MESH_SHAPE_PROXYTYPE, TERRAIN_SHAPE_PROXYTYPE};

}  // namespace

void UnitContacts::mark(btCollisionObject& body) {
  body.setUserIndex3(1);
}

bool UnitContacts::is_marked(const btCollisionObject& body) {
  return body.getUserIndex3() == 1;
}

UnitContacts::UnitContacts(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration,
                           const SlidingContacts* others) {
  const auto put = [&]<class Algorithm, class... More>(std::type_identity<Algorithm>, int a, int b, More... more) {
    btCollisionAlgorithmCreateFunc* former = others != nullptr ? others->of(a, b) : nullptr;
    if (former == nullptr) former = configuration.getCollisionAlgorithmCreateFunc(a, b);
    created_.push_back(std::make_unique<Make<Algorithm, More...>>(former, more...));
    dispatcher.registerCollisionCreateFunc(a, b, created_.back().get());
  };
  constexpr std::type_identity<ConvexContacts> convex;
  constexpr std::type_identity<PlaneContacts> plane;
  constexpr std::type_identity<SurfaceContacts> surface;
  constexpr std::type_identity<PartContacts> parts;
  constexpr int compound = COMPOUND_SHAPE_PROXYTYPE, half_space = STATIC_PLANE_PROXYTYPE;
  for (const int a : convex_types) {
    for (const int b : convex_types)
      // Two balls have one point, which Bullet knows.
      if (a != SPHERE_SHAPE_PROXYTYPE || b != SPHERE_SHAPE_PROXYTYPE) put(convex, a, b);
    put(plane, a, half_space, false);
    put(plane, half_space, a, true);
    put(parts, compound, a, false);
    put(parts, a, compound, true);
    for (const int b : surface_types) {
      put(surface, a, b, false);
      put(surface, b, a, true);
    }
  }
  for (const int b : {half_space, surface_types[0], surface_types[1]}) {
    put(parts, compound, b, false);
    put(parts, b, compound, true);
  }
  put(parts, compound, compound, false);
}

UnitContacts::~UnitContacts() = default;

}  // namespace boxstream::scenes
