// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/sliding_contacts.hpp"

#include <array>
#include <new>
#include <optional>
#include <tuple>
#include <type_traits>

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
    if (has_slid(*manifold(), share_) || (!boxes_ && manifold()->getNumContacts() < 3))
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

/// Of a half-space, on which Bullet finds one point of a body in a step: its algorithm until a point has moved aside,
/// and ours from then on.
class SlidingOnPlane final : public btCollisionAlgorithm {
 public:
  SlidingOnPlane(btCollisionAlgorithmCreateFunc& bullet, btCollisionAlgorithmConstructionInfo& info,
                 const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b, bool turned)
      : btCollisionAlgorithm(info), bullet_(bullet.CreateCollisionAlgorithm(info, a, b)), turned_(turned) {}
  ~SlidingOnPlane() override { drop_bullet(); }
  SlidingOnPlane(const SlidingOnPlane&) = delete;
  SlidingOnPlane& operator=(const SlidingOnPlane&) = delete;

  void processCollision(const btCollisionObjectWrapper* a, const btCollisionObjectWrapper* b,
                        const btDispatcherInfo& info, btManifoldResult* result) override {
    if (!ours_ && has_moved()) {
      drop_bullet();
      btCollisionAlgorithmConstructionInfo anew;
      anew.m_dispatcher1 = m_dispatcher;
      ours_.emplace(anew, a, b, turned_);
    }
    if (ours_)
      ours_->processCollision(a, b, info, result);
    else
      bullet_->processCollision(a, b, info, result);
  }
  btScalar calculateTimeOfImpact(btCollisionObject* a, btCollisionObject* b, const btDispatcherInfo& info,
                                 btManifoldResult* result) override {
    return bullet_ != nullptr ? bullet_->calculateTimeOfImpact(a, b, info, result) : btScalar(1);
  }
  void getAllContactManifolds(btManifoldArray& manifolds) override {
    if (ours_)
      ours_->getAllContactManifolds(manifolds);
    else
      bullet_->getAllContactManifolds(manifolds);
  }

 private:
  void drop_bullet() {
    if (bullet_ == nullptr) return;
    bullet_->~btCollisionAlgorithm();
    m_dispatcher->freeCollisionAlgorithm(bullet_);
    bullet_ = nullptr;
  }

  bool has_moved() {
    manifolds_.resizeNoInitialize(0);
    bullet_->getAllContactManifolds(manifolds_);
    for (int i = 0; i < manifolds_.size(); ++i)
      if (has_slid(*manifolds_[i], share)) return true;
    return false;
  }

  static constexpr auto share = btScalar(0.1);

  btCollisionAlgorithm* bullet_;
  std::optional<PlaneContacts> ours_;
  btManifoldArray manifolds_;
  bool turned_;
};

/// Of pairs that have a manifold to themselves, and friction.
template <class Algorithm, class... More>
class MakeSliding final : public btCollisionAlgorithmCreateFunc {
 public:
  explicit MakeSliding(btCollisionAlgorithmCreateFunc& bullet, More... more) : bullet_(bullet), arguments_(more...) {}

  btCollisionAlgorithm* CreateCollisionAlgorithm(btCollisionAlgorithmConstructionInfo& info,
                                                 const btCollisionObjectWrapper* a,
                                                 const btCollisionObjectWrapper* b) override {
    const btCollisionObject &one = *a->getCollisionObject(), &other = *b->getCollisionObject();
    const bool rubs = one.getFriction() * other.getFriction() > 0;
    if (info.m_manifold != nullptr || !rubs || !one.hasContactResponse() || !other.hasContactResponse())
      return bullet_.CreateCollisionAlgorithm(info, a, b);
    void* const place = info.m_dispatcher1->allocateCollisionAlgorithm(sizeof(Algorithm));
    return std::apply([&](More... more) { return new (place) Algorithm(bullet_, info, a, b, more...); }, arguments_);
  }

 private:
  btCollisionAlgorithmCreateFunc& bullet_;
  std::tuple<More...> arguments_;
};

// Balls have one point, which Bullet knows.
constexpr std::array<int, 5> types{BOX_SHAPE_PROXYTYPE, CAPSULE_SHAPE_PROXYTYPE, CYLINDER_SHAPE_PROXYTYPE,
                                   CUSTOM_CONVEX_SHAPE_TYPE, CONVEX_HULL_SHAPE_PROXYTYPE};

}  // namespace

SlidingContacts::SlidingContacts(btCollisionDispatcher& dispatcher, btCollisionConfiguration& configuration) {
  const auto put = [&]<class Algorithm, class... More>(std::type_identity<Algorithm>, int a, int b, More... more) {
    auto& made = created_[{a, b}];
    made = std::make_unique<MakeSliding<Algorithm, More...>>(*configuration.getCollisionAlgorithmCreateFunc(a, b),
                                                             more...);
    dispatcher.registerCollisionCreateFunc(a, b, made.get());
  };
  for (const int a : types) {
    for (const int b : types) put(std::type_identity<Sliding>(), a, b);
    put(std::type_identity<SlidingOnPlane>(), a, STATIC_PLANE_PROXYTYPE, false);
    put(std::type_identity<SlidingOnPlane>(), STATIC_PLANE_PROXYTYPE, a, true);
  }
}

SlidingContacts::~SlidingContacts() = default;

btCollisionAlgorithmCreateFunc* SlidingContacts::of(int a, int b) const {
  const auto found = created_.find({a, b});
  return found == created_.end() ? nullptr : found->second.get();
}

}  // namespace boxstream::scenes
