// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

// Coal was called hpp-fcl before, and has the headers of that, too.
#if __has_include(<coal/broadphase/broadphase_collision_manager.h>)
#define BOXSTREAM_COAL ::coal
#include <coal/broadphase/broadphase_callbacks.h>
#include <coal/broadphase/broadphase_collision_manager.h>
#include <coal/collision_object.h>
#else
#define BOXSTREAM_COAL ::hpp::fcl
#include <hpp/fcl/broadphase/broadphase_callbacks.h>
#include <hpp/fcl/broadphase/broadphase_collision_manager.h>
#include <hpp/fcl/collision_object.h>
#endif

#include <boxstream/detail/engine_box.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/object_set.hpp>

namespace boxstream::coal {

namespace engine = BOXSTREAM_COAL;
#undef BOXSTREAM_COAL

/// A broad-phase manager for Coal 3, the successor of FCL in Pinocchio, and for hpp-fcl 2.4, as it was called before:
///
///     boxstream::coal::CollisionManager manager;   // was: coal::DynamicAABBTreeCollisionManager manager;
///     pinocchio::BroadPhaseManagerTpl<boxstream::coal::CollisionManager> robot(&model, &geometry, &data);
///
/// What <boxstream/fcl.hpp> says of boxes, pairs, order, stop, distances, threads and errors holds here: boxes are
/// getAABB(), read when objects are registered and by update; pairs are exactly those whose boxes touch, each once, an
/// object never with itself; a callback that returns true is the last one of its query; near pairs come first. update()
/// takes flat boxes, for which Coal's trees throw. init() of the callback is called once a query, before anything else.
/// Other managers may be of any type; the reverse does not hold, for Coal's cast every other to their own. The tree's
/// settings are there, and have no effect.
class CollisionManager : public engine::BroadPhaseCollisionManager {
 public:
  using Base = engine::BroadPhaseCollisionManager;
  using Object = engine::CollisionObject;
  using S = std::remove_cv_t<std::remove_reference_t<decltype(std::declval<const engine::AABB&>().min_[0])>>;

  /// `executor` is borrowed and runs the search for all pairs; null: the calling thread does.
  explicit CollisionManager(Executor* executor) : set_(executor) {}
  CollisionManager() : CollisionManager(nullptr) {}
  CollisionManager(const CollisionManager&) = delete;
  CollisionManager& operator=(const CollisionManager&) = delete;

  int max_tree_nonbalanced_level = 10;
  int tree_incremental_balance_pass = 10;
  int tree_topdown_balance_threshold = 2;
  int tree_topdown_level = 0;
  int tree_init_level = 0;
  bool octree_as_geometry_collide = true;
  bool octree_as_geometry_distance = false;

  using Base::getObjects;

  void registerObjects(const std::vector<Object*>& objects) override {
    set_.reserve(objects.size());
    for (Object* const object : objects) registerObject(object);
  }
  void registerObject(Object* object) override {
    const Place place = set_.table().find(object);
    if (place == Set::none)
      set_.add(object, box_of(object), Filter{}, false);
    else
      set_.set_box(place, box_of(object));
  }
  void unregisterObject(Object* object) override {
    const Place place = set_.table().find(object);
    if (place != Set::none) set_.remove(place);
  }
  void setup() override {}
  void update() override {
    for (Place place = 0; place < set_.table().places(); ++place)
      if (const Object* const object = at(set_, place)) set_.set_box(place, box_of(object));
  }
  void update(Object* object) override {
    const Place place = set_.table().find(object);
    if (place != Set::none) set_.set_box(place, box_of(object));
  }
  void update(const std::vector<Object*>& objects) override {
    for (Object* const object : objects) update(object);
  }
  void clear() override { set_.clear(); }
  /// In order of registration.
  void getObjects(std::vector<Object*>& objects) const override {
    objects.clear();
    objects.reserve(size());
    for (Place place = 0; place < set_.table().places(); ++place)
      if (Object* const object = at(set_, place)) objects.push_back(object);
  }
  bool empty() const override { return size() == 0; }
  std::size_t size() const override { return set_.table().size(); }

  void collide(Object* object, engine::CollisionCallBackBase* callback) const override {
    callback->init();
    if (empty()) return;
    set_.for_each_overlap(box_of(object), Filter{}, Set::Order::any, [&](Place place) {
      Object* const mine = at(set_, place);
      return mine == object || !(*callback)(mine, object);
    });
  }
  void collide(engine::CollisionCallBackBase* callback) const override {
    callback->init();
    set_.for_each_pair([&](Place a, Place b) { return !(*callback)(at(set_, a), at(set_, b)); });
  }
  void collide(Base* other, engine::CollisionCallBackBase* callback) const override {
    if (other == this) return collide(callback);
    callback->init();
    with_set_of(*other, [&](const Set& others) {
      set_.for_each_pair(others, Set::Order::any, [&](Place a, Place b) {
        Object *const mine = at(set_, a), *const theirs = at(others, b);
        return mine == theirs || !(*callback)(mine, theirs);
      });
    });
  }

  void distance(Object* object, engine::DistanceCallBackBase* callback) const override {
    callback->init();
    if (empty()) return;
    S least = std::numeric_limits<S>::max();
    set_.for_each_near(box_of(object), Filter{}, least,
                       [&](Place place) { return asked(callback, at(set_, place), object, least); });
  }
  void distance(engine::DistanceCallBackBase* callback) const override {
    callback->init();
    S least = std::numeric_limits<S>::max();
    set_.for_each_near_pair(least, [&](Place a, Place b) { return asked(callback, at(set_, a), at(set_, b), least); });
  }
  void distance(Base* other, engine::DistanceCallBackBase* callback) const override {
    if (other == this) return distance(callback);
    callback->init();
    S least = std::numeric_limits<S>::max();
    with_set_of(*other, [&](const Set& others) {
      set_.for_each_near_pair(others, least,
                              [&](Place a, Place b) { return asked(callback, at(set_, a), at(others, b), least); });
    });
  }

 private:
  using Set = BasicObjectSet<S>;
  using Place = typename Set::Place;

  static Object* at(const Set& set, Place place) { return static_cast<Object*>(set.table().object(place)); }
  static BasicAabb<S> box_of(const Object* object) { return detail::box_of_engine<S>(object->getAABB()); }
  /// The limit of distances from now on; below 0 it ends the query.
  static S asked(engine::DistanceCallBackBase* callback, Object* first, Object* second, S& least) {
    return first != second && (*callback)(first, second, least) ? S(-1) : least;
  }
  template <class Use>
  void with_set_of(const Base& other, Use&& use) const {
    if (empty()) return;
    if (const auto* const same = dynamic_cast<const CollisionManager*>(&other)) {
      use(same->set_);
      return;
    }
    Set set;
    for (Object* const object : other.getObjects())
      if (set.table().find(object) == Set::none) set.add(object, box_of(object), Filter{}, false);
    use(set);
  }

  Set set_;
};

}  // namespace boxstream::coal
