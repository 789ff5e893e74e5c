// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <functional>
#include <type_traits>
#include <vector>

#include <fcl/broadphase/broadphase_collision_manager.h>

#include <boxstream/executor.hpp>
#include <boxstream/fcl/detail/box.hpp>
#include <boxstream/fcl/detail/wrong_other.hpp>
#include <boxstream/fcl/groups.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/object_set.hpp>

namespace boxstream::fcl {

/// A broad-phase manager for FCL that finds all pairs in one batch:
///
///     auto manager = std::make_shared<boxstream::fcl::CollisionManager<double>>();
///     // was: std::make_shared<fcl::DynamicAABBTreeCollisionManager<double>>();
///
/// First of all: FCL's managers cast every `other` to their own type, and crash with one of these. Where two managers
/// meet, change both, or ask the one that is changed, which takes managers of any type. (Debug builds print a line
/// before the crash where FCL is a shared library.)
///
/// @par Boxes
/// getAABB() is the only source (unless setBoxSource names another). Boxes of managed objects are read when they are
/// registered and by update, exactly, with no tolerance and no fat; the box of a query object when it is queried.
/// Closed: touching counts. Unbounded boxes and points are legal; a NaN bound is no bound, as in AABB::overlap; a box
/// with min > max touches nothing. setup() is never needed.
///
/// @par Pairs
/// Exactly those whose boxes touch, each once, never an object with itself (FCL's trees report a managed query object
/// against itself). Queries of an object are called back as (managed, query), those of two managers as (this, other).
/// Self queries go by the order of registration, of the first, then the second object of a pair. Other orders depend on
/// the history of calls alone, not on addresses or, but for which of several calls at once makes an index, on threads.
/// setRegistrationOrder makes them the order of registration
/// too; for a manager of a foreign type that is the order of its getObjects(). Which object of a pair comes first in a
/// self query of FCL's trees is a matter of where they are in the tree, so no comparison can tell; it changes from
/// update to update, and with it what a narrow phase answers that treats its two shapes unlike: contact points of two
/// meshes (DART) and of convex shapes against spheres (Tesseract) differ, and are as right.
///
/// @par Stop
/// A callback that returns true is the last one of this query. Few pairs beyond it are searched.
///
/// @par Distance
/// Pairs whose boxes are nearer to each other than `dist`. The callback may lower it, leave it, or set NaN, which ends
/// the query; after a higher value, pairs that were left out stay out. Near pairs come first, by roughly increasing
/// distance as long as `dist` falls. Their order depends on the history of calls alone; a query that is asked again may
/// have another one.
///
/// @par Octrees
/// Managed or queried, they count as their boxes. (For distance queries FCL's trees split a query octree by default,
/// and call back with a temporary box for each cell.)
///
/// @par Objects
/// Any number of managers may share one. Objects are not written to. An object may be destroyed right after
/// unregisterObject, and before clear() and the destructor. Registering an object again only reads its box again;
/// unregistering or updating an unknown object does nothing.
///
/// @par Threads
/// Const members may run on any number of threads at once. Everything else needs exclusive access. No lock is held
/// while a callback or an Executor runs: both may run other queries, of this manager too, and on the same thread. A
/// callback may throw. It must not change the manager.
///
/// @par Errors
/// After std::bad_alloc a part of the objects of the call may be registered or updated; all else is unchanged.
///
/// @par Cost
/// The first query that needs them makes an index, and the pairs of self queries; later queries bring them up to date.
/// With up to 128 objects pairs are found anew each time. Near pairs of two managers cost by what is near, whichever is
/// the larger one and whatever was registered before. To move an object, `update(object)` after computeAABB() is the
/// way: unregisterObject and registerObject take several times as long.
///
/// @par Memory
/// At most 90 bytes an object of doubles, 165 with an index. Once self queries hold pairs, 125 more and 8 a pair while
/// nothing moves, up to 660 more and 66 a pair while much does; `shrink_to_fit` gives back all but the first.
///
/// There is no continuous collision: register objects with swept boxes. Shapes are never read.
///
/// @par Names
/// With `using namespace boxstream;` a plain `fcl::` may mean either namespace, and compilers refuse it as ambiguous.
/// Write FCL's with a leading `::`, or name what is used: `using boxstream::fcl::CollisionManager;`.
template <class S>
class CollisionManager : public ::fcl::BroadPhaseCollisionManager<S> {
  static_assert(std::is_same_v<S, float> || std::is_same_v<S, double>, "boxstream knows float and double boxes");

 public:
  using Base = ::fcl::BroadPhaseCollisionManager<S>;
  using Object = ::fcl::CollisionObject<S>;
  using CollisionCallBack = ::fcl::CollisionCallBack<S>;
  using DistanceCallBack = ::fcl::DistanceCallBack<S>;

  /// `executor` is borrowed for the life of the manager and runs the search for all pairs in parallel; results do not
  /// depend on it, and callbacks run on the calling thread. Null: everything runs on the calling thread. No
  /// thread is started here. Of concurrent queries for all pairs the first one after a change uses the executor. The
  /// others wait for its result; those that must not, to avoid a deadlock, search on their own thread.
  explicit CollisionManager(Executor* executor) : set_(executor) {}
  CollisionManager() : CollisionManager(nullptr) {}
  /// With `Method::hybrid` all pairs of one manager, or of two, are found by the paper's tree, however few objects
  /// there are: to compare with.
  explicit CollisionManager(const DetectorOptions& options) : set_(options) {}
  ~CollisionManager() override = default;
  CollisionManager(const CollisionManager&) = delete;
  CollisionManager& operator=(const CollisionManager&) = delete;
  /// One that was moved from is as made by `CollisionManager()`.
  CollisionManager(CollisionManager&& other) noexcept : CollisionManager() { swap(other); }
  CollisionManager& operator=(CollisionManager&& other) noexcept;
  void swap(CollisionManager& other) noexcept;

  /// The settings of FCL's trees, with the same defaults, so that programs that set them compile. They have no effect.
  int max_tree_nonbalanced_level = 10;
  int tree_incremental_balance_pass = 10;
  int tree_topdown_balance_threshold = 2;
  int tree_topdown_level = 0;
  int tree_init_level = 0;
  bool octree_as_geometry_collide = true;
  bool octree_as_geometry_distance = false;

  void registerObjects(const std::vector<Object*>& objects) override;
  void registerObject(Object* object) override;
  void unregisterObject(Object* object) override;
  /// Does nothing, at any time.
  void setup() override {}
  /// Reads the boxes of all objects except static ones; static ones too if margin or source has changed since the last
  /// call.
  void update() override;
  /// Reads the boxes of the given objects, static or not.
  void update(Object* object) override;
  void update(const std::vector<Object*>& objects) override;
  void clear() override;
  /// Gives back all memory but that of the objects that are managed; queries make what they need anew.
  void shrink_to_fit() { set_.shrink_to_fit(); }
  /// Replaces the contents of `objects`; they are in order of registration.
  void getObjects(std::vector<Object*>& objects) const override;
  bool empty() const override { return set_.table().size() == 0; }
  std::size_t size() const override {
    if (asked_ == this) {
      asked_ = nullptr;  // see as_same_type
      return set_.table().size();
    }
#ifdef BOXSTREAM_FCL_KNOWS_ITS_CALLERS
    detail::warn_of_wrong_other(__builtin_return_address(0));
#endif
    return set_.table().size();
  }

  void collide(Object* object, void* cdata, CollisionCallBack callback) const override;
  void collide(void* cdata, CollisionCallBack callback) const override;
  /// With itself it is a self query. For a manager of another type, boxes are read from its objects now.
  void collide(Base* other, void* cdata, CollisionCallBack callback) const override;
  void distance(Object* object, void* cdata, DistanceCallBack callback) const override;
  void distance(void* cdata, DistanceCallBack callback) const override;
  void distance(Base* other, void* cdata, DistanceCallBack callback) const override;

  // What follows is not part of FCL's interface.

  /// With true, all pairs of `collide` come in the order of registration: of the managed object, or of the objects of
  /// this manager and then of the other one. Those of `distance` come as before. All hits of an object are then found
  /// and sorted before its first callback, even if that ends the query. With another manager that is done for each
  /// object of this one, and takes longer.
  void setRegistrationOrder(bool on) {
    order_ = on ? Set::Order::places : Set::Order::any;
  }

  /// Called for each pair before the callback, with the objects in the same order; false drops the pair. An empty
  /// function removes the filter. Runs on the calling thread; may throw.
  using PairFilter = std::function<bool(const Object*, const Object*)>;
  void setPairFilter(PairFilter filter) {
    filter_ = std::move(filter);
  }

  /// Bits by which pairs are filtered before they are found. The default is `Groups{}`. A query object has the bits
  /// with which it is managed, or those passed to the next two functions. False, and nothing done, for unknown objects.
  bool setGroups(Object* object, Groups groups);
  void collide(Object* object, Groups groups, void* cdata, CollisionCallBack callback) const;
  void distance(Object* object, Groups groups, void* cdata, DistanceCallBack callback) const;

  /// Static objects never pair with each other, and update() reads their boxes only after setMargin and setBoxSource.
  /// False for unknown objects.
  bool setStatic(Object* object, bool is_static = true);
  void registerStaticObjects(const std::vector<Object*>& objects);

  /// Boxes touch if no axis keeps them further apart than `margin` (in the unit of the boxes; NaN and less than 0
  /// count as 0): each grows by half of it on all sides, rounded outward. Boxes already read grow when they are read
  /// again; update() reads all, static ones too, and so completes a change. Distances between boxes shrink as well.
  void setMargin(S margin);

  /// Where boxes come from instead of getAABB(), for managed and query objects alike; null: from there. Must contain
  /// the shape. Boxes already read stay until they are read again, as with setMargin. <boxstream/fcl/tight_box.hpp> has
  /// one to use.
  using BoxSource = ::fcl::AABB<S> (*)(const Object&);
  void setBoxSource(BoxSource source);

  /// Calls `visit(object, t)` for each managed object whose box the segment from `from` to `to` meets, by increasing t
  /// (from 0 to 1, where it enters the box; 0 if it starts inside), ties by registration, until it returns true.
  /// Closed, within the rounding of one subtraction and one multiplication.
  using RayVisitor = FunctionRef<bool(Object* object, S t)>;
  void rayCast(const ::fcl::Vector3<S>& from, const ::fcl::Vector3<S>& to, RayVisitor visit) const;

  /// What is wrong with the box of an object.
  enum class Stale {
    not_updated,   ///< it is not the box that was last read: update is due
    not_computed,  ///< it does not contain the local box where the transform puts it: computeAABB() is due
  };
  /// Calls `visit` for each managed object with a stale box, a static one too, in order of registration; reads all
  /// objects. Returns how many there are.
  std::size_t findStale(FunctionRef<void(const Object*, Stale)> visit) const;
  /// For debugging: from now on all queries begin with findStale and print one line to stderr if they find anything.
  void setStaleWarning(bool on) {
    warns_ = on;
  }

  /// Checks every internal invariant; for tests. Throws std::logic_error with the first one broken.
  void validate() const {
    set_.validate();
  }

 private:
  using Set = BasicObjectSet<S>;
  using Box = BasicAabb<S>;
  using Place = typename Set::Place;

  static Object* object_at(const Set& set, Place place) {
    return static_cast<Object*>(set.table().object(place));
  }
  Object* managed(Place place) const {
    return object_at(set_, place);
  }
  Box read(const Object& object) const {
    return reads_aabb_ ? detail::box_of(object.getAABB()) : read_otherwise(object);
  }
  Box read_otherwise(const Object& object) const;
  void put(Object* object, bool is_static);
  Filter filter_of_query(const Object* object) const;
  void collide_with(Object* object, Filter filter, void* cdata, CollisionCallBack callback) const;
  void distance_to(Object* object, Filter filter, void* cdata, DistanceCallBack callback) const;
  static const CollisionManager* as_same_type(const Base& other);
  template <class Use>
  void with_set_of(Base* other, Use&& use) const;
  bool passes(Object* first, Object* second) const {
    return first != second && (!filter_ || filter_(first, second));
  }
  static bool is_computed(const Object& object);
  void warn() const;

  static inline thread_local const Base* asked_ = nullptr;

  Set set_;
  PairFilter filter_;
  BoxSource source_ = nullptr;
  S reach_ = 0;
  bool reads_aabb_ = true;     // as it is: no source, no margin
  bool all_outdated_ = false;  // margin or source has changed since update() has read what was there
  bool warns_ = false;
  typename Set::Order order_ = Set::Order::any;
};

}  // namespace boxstream::fcl

#include <boxstream/fcl/detail/collide.hpp>
#include <boxstream/fcl/detail/distance.hpp>
#include <boxstream/fcl/detail/objects.hpp>
#include <boxstream/fcl/detail/ray_cast.hpp>
#include <boxstream/fcl/detail/same_type.hpp>
#include <boxstream/fcl/detail/stale.hpp>

#ifdef BOXSTREAM_FCL_COMPILED
namespace boxstream::fcl {
extern template class CollisionManager<float>;
extern template class CollisionManager<double>;
}  // namespace boxstream::fcl
#endif
