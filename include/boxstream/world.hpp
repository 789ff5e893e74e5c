// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include <boxstream/aabb.hpp>
#include <boxstream/detail/export.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/plane.hpp>
#include <boxstream/ray.hpp>
#include <boxstream/span.hpp>
#include <boxstream/splice.hpp>

namespace boxstream {

/// Identifies a proxy of one World. The id of a destroyed proxy stays stale: its slot is used again with another
/// generation. A default-constructed id is null.
struct ProxyId {
  std::uint32_t slot = 0;
  std::uint32_t generation = 0;

  explicit constexpr operator bool() const { return generation != 0; }
  friend constexpr bool operator==(ProxyId x, ProxyId y) { return x.slot == y.slot && x.generation == y.generation; }
  friend constexpr bool operator!=(ProxyId x, ProxyId y) { return !(x == y); }
};

/// Two proxies that overlap; `a` was created before `b`.
struct ProxyPair {
  ProxyId a;
  ProxyId b;
};

/// Called for a pair that overlaps and that group and mask accept. False refuses the pair.
using ProxyPairFilter = FunctionRef<bool(ProxyId a, ProxyId b)>;

/// Receives pairs in batches. False stops.
using ProxyPairSink = FunctionRef<bool(Span<const ProxyPair>)>;

/// Called for each proxy found, in no particular order. False stops the query.
using ProxyVisitor = FunctionRef<bool(ProxyId id)>;

/// Called for each proxy that a ray hits, at t = `enter` (0 if the ray starts inside).
/// Returns the new length of the ray: `length` to see all hits, less to clip, negative to stop the query.
template <class S>
using RayVisitor = FunctionRef<S(ProxyId id, S enter, S length)>;

/// Called for proxies, near ones first. `distance` is a lower bound of the distance between the boxes.
/// Returns the new limit, which may be lower or higher than before. The query continues with boxes whose distance is
/// below it; zero, a negative value or NaN stops the query.
template <class S>
using NearVisitor = FunctionRef<S(ProxyId id, S distance)>;

/// The same for pairs of proxies.
template <class S>
using NearPairVisitor = FunctionRef<S(ProxyPair pair, S distance)>;

/// How a World runs.
struct WorldOptions {
  /// Borrowed for the life of the World; null: everything runs on the calling thread.
  Executor* executor = nullptr;

  /// False: a held pair ends at the next update if changed filter bits refuse it.
  /// True: filters are tested only when a pair begins.
  bool sticky_filters = false;

  /// With `Method::hybrid` each update in which a box has changed is one batch of all, by the paper's tree: nothing is
  /// probed or kept. `cutoff` as in DetectorOptions.
  Method method = Method::planned;
  std::uint32_t cutoff = 0;
};

/// What one update did.
struct WorldStats {
  std::uint64_t proxies = 0;
  std::uint64_t invalid = 0;  ///< proxies whose box has a NaN or min > max
  std::uint64_t moved = 0;    ///< proxies whose box changed since the last update, new ones included
  std::uint64_t pairs = 0;    ///< pairs held now
  std::uint64_t begun = 0;
  std::uint64_t ended = 0;
  Stats search;  ///< of the batch, if one ran, which may depend on how soon threads start
};

/// Boxes that live from frame to frame. An update reports which pairs began and ended; queries see the present boxes.
///
/// @par Boxes
/// Exact, no margin is added, and touching counts. An invalid box (NaN, min > max) has no pairs and is found by no
/// query until a later `move` repairs it.
///
/// @par Order
/// Pairs are sorted by creation of `a`, then of `b`, whatever the history.
///
/// @par Floating point
/// Results do not depend on rounding mode, flushing of denormals or traps. No call traps or changes flags. Callbacks
/// run in the environment of their caller.
///
/// @par Threads
/// Queries (const members) may run on any number of threads at once. They see every earlier change. Everything else
/// needs exclusive access.
///
/// @par Callbacks
/// May query the World but must not change it; debug builds assert.
///
/// @par Ids
/// Calls with a stale or null id return false or null values.
///
/// @par Errors
/// std::bad_alloc, and std::length_error beyond 2^32 - 2 proxies or 2^32 - 64 pairs held, leave the World unchanged.
///
/// @par Cost
/// Setting a box that has not changed costs a compare. An update costs a search of the boxes that moved or one batch of
/// all, whichever is cheaper, and some nanoseconds for each pair.
///
/// @par Memory
/// In bytes, of floats (doubles): 74 (98) a box and 8 a pair after `shrink_to_fit`, and with what updates and queries
/// keep at most 450 (660) and 66. Of the latter, where boxes move little, are candidates (pairs that nearly touch), at
/// most eight for each box and four for each pair, which an update then mostly scans. What many pairs that begin or end
/// at once take goes back after eight updates with far fewer. Ids that have been used take 12.
///
/// There are no shapes, bodies or contacts, and no data per pair.
template <class S>
class BOXSTREAM_API BasicWorld {
 public:
  using Box = BasicAabb<S>;

  explicit BasicWorld(WorldOptions options = {});
  ~BasicWorld();
  BasicWorld(BasicWorld&&) noexcept;
  BasicWorld& operator=(BasicWorld&&) noexcept;

  /// A new proxy; its pairs begin at the next update. `user` is user data.
  ProxyId create(const Box& box, Filter filter = {}, std::uint64_t user = 0);

  /// As `create` for each box, much faster: `out[i]` is the id for `boxes[i]`.
  /// `out` is as long as `boxes`; `filters` and `users` are empty or as long; otherwise std::invalid_argument.
  /// After an exception no proxy has been created.
  void create(Span<const Box> boxes, Span<const Filter> filters, Span<ProxyId> out,
              Span<const std::uint64_t> users = {});

  /// The id is stale on return. Pairs end at the next update; their events have the stale id.
  bool destroy(ProxyId id);

  /// As `destroy` for each id. Returns how many were live.
  std::size_t destroy(Span<const ProxyId> ids);

  /// Back to the state of a new World: no proxies, pairs or events, and ids start again.
  void clear();

  /// Gives back all memory but that of the proxies and pairs that are here: see above. The next update and the next
  /// query make what they need anew, so that this is for times when nothing moves. Ids, pairs and events stay.
  void shrink_to_fit();

  /// Replaces the box; costs a compare when nothing changed.
  bool move(ProxyId id, const Box& box);

  /// As `move` for each id, at a fraction of the cost; fastest if ids are in order of creation. Returns how many were
  /// live. std::invalid_argument unless there are as many boxes as ids.
  std::size_t move(Span<const ProxyId> ids, Span<const Box> boxes);

  bool set_filter(ProxyId id, Filter filter);
  bool set_user(ProxyId id, std::uint64_t user);

  bool contains(ProxyId id) const;
  std::size_t size() const;
  /// The next three need a live id.
  Box box(ProxyId id) const;
  Filter filter(ProxyId id) const;
  std::uint64_t user(ProxyId id) const;

  /// Brings pairs up to date with boxes and filters.
  /// `accept` is called for each new pair that group and mask accept; false refuses it.
  /// A refused pair does not begin later, and `accept` is not called for it again, until the box or the filter of one
  /// of the two changes, or after `refilter` or `release`. Refusals take no memory and no time, however many they are:
  /// pairs are asked about in their order, or, where there are thousands, so in portions while they are found.
  WorldStats update();
  WorldStats update(ProxyPairFilter accept);

  /// The same for callers that know what has changed: pairs in `begin` touch now, and held ones in `end` no longer do.
  /// No other pair has changed. Nothing is searched, and no box is read: those that have moved are searched for by the
  /// next `update`. Pairs that are held already, or are not, or of stale ids, are left out. Group and mask are not
  /// tested: `begin` has pairs that they accept.
  WorldStats update_told(Span<const ProxyPair> begin, Span<const ProxyPair> end, ProxyPairFilter accept);

  /// The same for one pair between updates, as by `begin_pairs_of`: held from now on, it is not reported as begun.
  /// False if it is held already, or of stale ids.
  bool begin_told(ProxyId a, ProxyId b);

  /// After an update: true if a box that moves again and again has a room. Until another call changes anything, no pair
  /// begins or ends while it is within `outer` and its low ends are at most, its high ends at least those of `inner`.
  /// It need not be moved then.
  bool room(ProxyId id, Box& outer, Box& inner);

  /// For an `accept` whose answers have changed: the next update calls it again for all refused pairs of one proxy, or
  /// of all. Costs as much as if their boxes had changed.
  bool refilter(ProxyId id);
  void refilter();

  /// From now on an update in which more than `most` pairs would begin throws std::length_error, soon after it has
  /// found that many. For callers that have another way to handle many pairs. A pair that `accept` refuses counts until
  /// it has been asked about it.
  void set_max_begun(std::uint64_t most);

  /// Pairs that began, and ended, in the last update. Valid until the next call that is not const.
  Span<const ProxyPair> begun() const;
  Span<const ProxyPair> ended() const;

  /// Indices in the order of all held pairs: of `ended()` before the last update, and of `begun()` after it. By
  /// `splice`, an array with an element for each pair follows. Valid as long as `begun()`.
  Splice changes() const;

  /// Index of a pair in the order of all held pairs; nothing if it is not held. For arrays that follow changes between
  /// updates too.
  std::optional<std::uint32_t> pair_place(ProxyId a, ProxyId b) const;

  /// All pairs held, in order. Stops when the visitor returns false.
  std::uint64_t pair_count() const;
  void for_each_pair(FunctionRef<bool(ProxyPair)> visit) const;

  /// The same, faster, in batches. Batches are not empty, and valid during the call only. Stops when the sink returns
  /// false.
  void stream_pairs(ProxyPairSink sink) const;

  /// Begins pairs of one proxy now instead of in the next update.
  /// Each new pair is held from now on and passed to `begin`. No later update reports it as begun.
  /// `accept` is called for overlapping pairs that are not held and that group and mask accept. With `accept_alone`
  /// group and mask are not tested: for filters that the World does not have yet. If it never gets them, the pair ends
  /// at some later update, but with `sticky_filters` stays while the boxes touch. Pairs passed on before a
  /// std::bad_alloc stay held.
  void begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin,
                      bool accept_alone = false);

  /// The same for callers that do it at every change of a box. `settled` is the box of this proxy at the last call:
  /// pairs with proxies that touch it are left out, because they have begun or been refused.
  void begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin, bool accept_alone,
                      const Box& settled);

  /// Resets a pair, held or refused: if it overlaps, the next update filters it and reports it as begun. Returns true
  /// if it was held.
  bool release(ProxyId a, ProxyId b);

  /// Proxies whose box overlaps or touches `box`.
  void query_box(const Box& box, ProxyVisitor visit) const;

  /// Proxies whose box `is_behind` none of the planes: those inside a convex region, those that reach into it, and some
  /// near its edges. Any number of planes; more than 16 allocate memory. With none, all valid proxies.
  void query_planes(Span<const BasicPlane<S>> planes, ProxyVisitor visit) const;

  /// Proxies hit by the ray, or by the box swept along it. Closed at faces and at both ends, within the rounding of
  /// one subtraction and one multiplication per side.
  void query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) const;

  /// Fills `out` with the proxies whose boxes are nearest to `point`, nearest first, ties in order of creation.
  /// Returns how many there are: less than out.size() only if the World has fewer valid proxies.
  /// Distances are compared exactly, without rounding. A NaN coordinate of `point` counts as distance 0 on its axis.
  std::size_t query_nearest(const S (&point)[3], Span<ProxyId> out) const;

  /// Proxies whose boxes are nearer to `box` than the limit, roughly nearest first. The limit is `limit` at first, then
  /// the last result of the visitor. Infinity is no limit. A visitor that returns the least distance so far sees few
  /// boxes but the nearest. The order depends only on the history of calls. After a higher limit than before, boxes
  /// that were left out may stay out.
  ///
  /// @par Distances
  /// Euclidean, rounded down by some units in the last place, never above the exact ones. Always finite: those beyond
  /// the largest finite number are that number. They depend only on the two boxes.
  ///
  /// @par Memory
  /// None but to bring the index up to date, and for over 32 of `query_nearest` or 16 planes of `query_planes`.
  void query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const;

  /// The same for all pairs that group and mask accept, each once; `a` was created before `b`.
  void nearest_pairs(S limit, NearPairVisitor<S> visit) const;

  /// The same for pairs of a proxy `a` of this World and `b` of another. If `other` is this World: as above.
  void nearest_pairs(const BasicWorld& other, S limit, NearPairVisitor<S> visit) const;

  /// A box that contains all valid proxies; invalid (min > max) if there are none.
  Box bounds() const;

  /// Checks all internal invariants; for tests. Throws std::logic_error with the first one broken.
  void validate() const;

 protected:
  struct BOXSTREAM_LOCAL Impl;
  BOXSTREAM_LOCAL explicit BasicWorld(std::unique_ptr<Impl> impl) noexcept;

 private:
  std::unique_ptr<Impl> impl_;
};

using World = BasicWorld<float>;
using World64 = BasicWorld<double>;

}  // namespace boxstream
