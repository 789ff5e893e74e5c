// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/sliding_contacts.hpp"

#include <array>
#include <new>

#include <BulletCollision/CollisionDispatch/btBoxBoxCollisionAlgorithm.h>
#include <BulletCollision/CollisionDispatch/btCollisionConfiguration.h>
#include <BulletCollision/CollisionDispatch/btCollisionCreateFunc.h>
#include <BulletCollision/CollisionDispatch/btCollisionDispatcher.h>

#include "simulation/engine/contacts/pair_contacts.hpp"

namespace boxstream::scenes {
namespace {

bool is_box(const btCollisionObjectWrapper& wrap) {
  return wrap.getCollisionShape()->getShapeType() == BOX_SHAPE_PROXYTYPE;
}

btCollisionAlgorithm* bullet_algorithm(btCollisionAlgorithmCreateFunc& bullet,
                                       btCollisionAlgorithmConstructionInfo& info, const btCollisionObjectWrapper* a,
                                       const btCollisionObjectWrapper* b) {
  if (!is_box(*a) || !is_box(*b)) return bullet.CreateCollisionAlgorithm(info, a, b);
  // What makes Bullet's own takes no manifold.
  void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(btBoxBoxCollisionAlgorithm));
  return new (place) btBoxBoxCollisionAlgorithm(info.m_manifold, info, a, b);
}

/// Bullet's algorithm, in a manifold of ours, until points have moved aside.
class Sliding final : public ConvexContacts {
 public:
  Sliding(btCollisionAlgorithmCreateFunc& bullet, const btCollisionAlgorithmConstructionInfo& info,
          const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b)
      : ConvexContacts(info, a, b), boxes_(is_box(*a) && is_box(*b)), share_(boxes_ ? of_boxes : of_others) {
    btCollisionAlgorithmConstructionInfo shared = info;
    shared.m_manifold = manifold();
    bullet_ = bullet_algorithm(bullet, shared, a, b);
  }
  ~Sliding() override {
    bullet_->~btCollisionAlgorithm();
    m_dispatcher->freeCollisionAlgorithm(bullet_);
  }
  Sliding(const Sliding&) = delete;
  Sliding& operator=(const Sliding&) = delete;

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override {
    if (has_slid(share_) || (!boxes_ && manifold()->getNumContacts() < 3))
      return ConvexContacts::processCollision(a, b, info, result);
    bullet_->processCollision(a, b, info, result);
    refresh(*result);
  }
  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override {
    return bullet_->calculateTimeOfImpact(a, b, info, result);
  }

 private:
  // Of boxes Bullet finds several points in a step, of others one, on which they rock.
  static constexpr auto of_boxes = btScalar(0.1), of_others = btScalar(0.002);

  bool boxes_;
  btScalar share_;
  btCollisionAlgorithm* bullet_;
};

/// Of pairs that have a manifold to themselves, and friction.
class MakeSliding final : public btCollisionAlgorithmCreateFunc {
 public:
  explicit MakeSliding(btCollisionAlgorithmCreateFunc& bullet) : bullet_(bullet) {}

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* a,
                                                 const btCollisionObjectWrapper* b) override {
    const btCollisionObject &one = *a->getCollisionObject(), &other = *b->getCollisionObject();
    const bool rubs = one.getFriction() * other.getFriction() > 0;
    if (info.m_manifold != nullptr || !rubs || !one.hasContactResponse() || !other.hasContactResponse())
      return bullet_.CreateCollisionAlgorithm(info, a, b);
    void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Sliding));
    return new (place) Sliding(bullet_, info, a, b);
  }

 private:
  btCollisionAlgorithmCreateFunc& bullet_;
};

// Balls have one point, which Bullet knows.
constexpr std::array<int, 5> types{BOX_SHAPE_PROXYTYPE, CAPSULE_SHAPE_PROXYTYPE, CYLINDER_SHAPE_PROXYTYPE,
                                   CUSTOM_CONVEX_SHAPE_TYPE, CONVEX_HULL_SHAPE_PROXYTYPE};

}  // namespace

SlidingContacts::SlidingContacts(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration) {
  for (const int a : types)
    for (const int b : types) {
      auto& made = created_[{a, b}] =
          std::make_unique<MakeSliding>(*configuration.getCollisionAlgorithmCreateFunc(a, b));
      dispatcher.registerCollisionCreateFunc(a, b, made.get());
    }
}

SlidingContacts::~SlidingContacts() = default;

btCollisionAlgorithmCreateFunc* SlidingContacts::of(int a, int b) const {
  const auto found = created_.find({a, b});
  return found == created_.end() ? nullptr : found->second.get();
}

}  // namespace boxstream::scenes
