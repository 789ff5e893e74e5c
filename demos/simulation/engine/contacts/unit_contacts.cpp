// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/unit_contacts.hpp"

#include <array>
#include <new>
#include <tuple>
#include <type_traits>

#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include "simulation/engine/contacts/pair_contacts.hpp"
#include "simulation/engine/contacts/part_contacts.hpp"
#include "simulation/engine/contacts/sliding_contacts.hpp"

namespace boxstream::scenes {
namespace {

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
