// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include <boxstream/aabb.hpp>
#include <boxstream/detector.hpp>
#include <boxstream/executor.hpp>
#include <boxstream/function_ref.hpp>
#include <boxstream/plane.hpp>
#include <boxstream/ray.hpp>
#include <boxstream/span.hpp>
#include <boxstream/splice.hpp>

namespace boxstream {

/// Names a proxy of one World for as long as the proxy lives. A destroyed proxy's id is stale for ever: its slot is
/// used again with another generation. A default-made id is null and names nothing.
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

/// Asked about a pair that overlaps and that group and mask accept; false refuses the pair.
using ProxyPairFilter = FunctionRef<bool(ProxyId a, ProxyId b)>;

/// Receives pairs in batches; returns false to stop.
using ProxyPairSink = FunctionRef<bool(Span<const ProxyPair>)>;

/// Called for each proxy found, in no particular order; false stops the query.
using ProxyVisitor = FunctionRef<bool(ProxyId id)>;

/// Called for each proxy that a ray meets, `enter` being where (0 if it starts inside). Returns the t beyond which hits
/// are of no more interest (the length it was given, to see everything); a negative value stops the query.
template <class S>
using RayVisitor = FunctionRef<S(ProxyId id, S enter, S length)>;

/// Called for proxies, near ones first. `distance` is a lower bound of the distance between the boxes. Returns the
/// limit from now on, which may be less or more than before or the same: the query goes on to boxes whose distance is
/// below it, and there are none if it is zero, negative or NaN.
template <class S>
using NearVisitor = FunctionRef<S(ProxyId id, S distance)>;

/// The same for pairs of proxies.
template <class S>
using NearPairVisitor = FunctionRef<S(ProxyPair pair, S distance)>;

/// How a World runs.
struct WorldOptions {
  /// Borrowed for the life of the World; null: everything runs on the calling thread.
  Executor* executor = nullptr;

  /// What a change of filter bits does to a pair that is held. False: it ends at the next update if they refuse it now.
  /// True: filters are asked when a pair begins, never again while it goes on overlapping.
  bool sticky_filters = false;
};

/// What one update did.
struct WorldStats {
  std::uint64_t proxies = 0;
  std::uint64_t invalid = 0;  ///< proxies whose box has a NaN or min > max
  std::uint64_t moved = 0;    ///< proxies whose box changed since the update before, new ones included
  std::uint64_t pairs = 0;    ///< pairs held now
  std::uint64_t begun = 0;
  std::uint64_t ended = 0;
  Stats search;  ///< of the batch that was run, if any
};

/// Boxes that live from frame to frame: says which pairs began and ended since the last update, and answers queries
/// about the boxes as they are now.
///
/// Boxes are exact: no margin is added, touching counts, an invalid box pairs with nothing and is found by no query
/// until a later `move` repairs it. Pairs come in the order of creation of `a`, then of `b`, whatever the history.
///
/// Floating point: results do not depend on rounding mode, flushing of denormal numbers or traps, which may differ from
/// call to call and from thread to thread. No call traps; the flags stay as they are. Callbacks run in the environment
/// of their caller.
/// Threads: queries (const members) may run at the same time from any number of threads, and see every earlier change.
/// Everything else needs the World to itself.
/// Errors: calls that take an id return false, or null values, for a stale or null one. std::bad_alloc, and
/// std::length_error beyond 2^32 - 2 proxies or 2^32 - 64 pairs held, leave the World as it was. Callbacks may query
/// the World but must not change it: debug builds assert.
/// Cost: a box at rest costs a compare if it is set again, and nothing else. An update costs a search of the boxes that
/// moved, or one batch of all, whichever is cheaper, and some nanoseconds for each pair.
/// Memory: where boxes move little, candidates (pairs that nearly touch) are kept as well, at most eight for each box
/// and two for each pair, of 40 bytes; an update then mostly scans these candidates.
///
/// It knows no shapes, bodies or contacts, and stores nothing per pair but its existence.
template <class S>
class BasicWorld {
 public:
  using Box = BasicAabb<S>;

  explicit BasicWorld(WorldOptions options = {});
  ~BasicWorld();
  BasicWorld(BasicWorld&&) noexcept;
  BasicWorld& operator=(BasicWorld&&) noexcept;

  /// A new proxy; its pairs begin at the next update. `user` is a word for the caller's own use.
  ProxyId create(const Box& box, Filter filter = {}, std::uint64_t user = 0);

  /// As one `create` for each box in entry, much faster: `out[i]` names the proxy of `boxes[i]`. `filters` and `users`
  /// are empty or as long as `boxes`, `out` is as long as `boxes`; else std::invalid_argument. All are made or none.
  void create(Span<const Box> boxes, Span<const Filter> filters, Span<ProxyId> out,
              Span<const std::uint64_t> users = {});

  /// Its pairs end at the next update (their events carry the stale id). The id is stale on return.
  bool destroy(ProxyId id);

  /// As one `destroy` for each id in entry; returns how many were live.
  std::size_t destroy(Span<const ProxyId> ids);

  /// Destroys all proxies and forgets all history, pairs included, without events: ids start again as in a new World.
  void clear();

  /// Replaces the box; costs a compare when nothing changed.
  bool move(ProxyId id, const Box& box);

  /// As one `move` for each id in entry, at a fraction of the cost, least if the ids are in order of creation. As many
  /// boxes as ids, or std::invalid_argument. Returns how many ids were live; boxes given to others are ignored.
  std::size_t move(Span<const ProxyId> ids, Span<const Box> boxes);

  bool set_filter(ProxyId id, Filter filter);
  bool set_user(ProxyId id, std::uint64_t user);

  bool contains(ProxyId id) const;
  std::size_t size() const;
  /// Each of the next three needs a live id.
  Box box(ProxyId id) const;
  Filter filter(ProxyId id) const;
  std::uint64_t user(ProxyId id) const;

  /// Brings pairs up to date with boxes and filters. `accept`, if given, is called last for each new pair; false
  /// rejects it. A rejected pair does not begin in later updates either, with or without `accept`, and `accept` is not
  /// called for it, until the box or the filter of one of the two changes, or `ask_again` or `release` names it.
  /// Refusals take no memory and no time.
  WorldStats update();
  WorldStats update(ProxyPairFilter accept);

  /// For callers whose `accept` may now answer otherwise: the next update asks again about all pairs of one proxy, or
  /// of all, that it refused. Costs as much as if their boxes had changed.
  bool ask_again(ProxyId id);
  void ask_again();

  /// From now on an update that finds more than `most` pairs to begin throws std::length_error, before it has found
  /// many more. For callers that can do without holding pairs.
  void limit_begun(std::uint64_t most);

  /// Pairs that began, and ended, in the last update. Valid until the next call that is not const.
  Span<const ProxyPair> begun() const;
  Span<const ProxyPair> ended() const;

  /// Where these were and are in the order of all pairs held: places before the last update of `ended()`, and after it
  /// of `begun()`, one for each. An array with an element a pair follows by `splice`. Valid as `begun()`.
  Splice changes() const;

  /// How many pairs held come before this one; nothing if it is not held. For arrays that are to follow what begins and
  /// is released between updates as well.
  std::optional<std::uint32_t> pair_place(ProxyId a, ProxyId b) const;

  /// All pairs held, in order. Stops when the visitor returns false.
  std::uint64_t pair_count() const;
  void for_each_pair(FunctionRef<bool(ProxyPair)> visit) const;

  /// The same, faster, in batches that are never empty and valid during the call only. Stops when the sink returns
  /// false.
  void stream_pairs(ProxyPairSink sink) const;

  /// Looks for pairs of one proxy without waiting for the next update: each that begins is held from now on and passed
  /// to `begin` (which may query the World, not change it), and no later update reports it as begun. `accept` is asked
  /// about all that are not held and that group and mask accept; about all that are not held if `accept_alone`, for
  /// callers with filters that the World does not know yet. Pairs that were passed on before std::bad_alloc
  /// stay.
  void begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin,
                      bool accept_alone = false);

  /// The same for callers that do it whenever a box changes: pairs with proxies whose box touches `settled`, the
  /// box of this proxy when it was done last, are left out. They were begun or refused by then.
  void begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin, bool accept_alone,
                      const Box& settled);

  /// Forgets what is known of a pair: if it overlaps, the next update asks about it and reports it as begun, though it
  /// was held or refused before. Returns true if it was held.
  bool release(ProxyId a, ProxyId b);

  /// Proxies whose box overlaps or touches `box`.
  void query_box(const Box& box, ProxyVisitor visit) const;

  /// Proxies that lie in a convex region or reach into it, as far as its planes can tell one by one: those whose box
  /// `is_behind` none of them. Any number of planes; with none, all valid proxies. More than 16 take memory.
  void query_planes(Span<const BasicPlane<S>> planes, ProxyVisitor visit) const;

  /// Proxies that the ray, or the box swept along it, meets (closed at faces and at both ends, within the rounding of
  /// one subtraction and one multiplication per side).
  void query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) const;

  /// Fills `out` with the proxies whose boxes are nearest to `point`, nearest first, ties in order of creation, and
  /// returns how many there were (less than out.size() only if the World has fewer valid proxies). Nothing is rounded:
  /// a tie is one of the exact distances. A NaN coordinate of `point` is at no distance from any box.
  std::size_t query_nearest(const S (&point)[3], Span<ProxyId> out) const;

  /// Proxies whose boxes are nearer to `box` than the limit: the one given first, then what the visitor returned last.
  /// Infinity is no limit. Near ones come first as far as the index can tell, not in order; a visitor that returns the
  /// least distance so far sees few but the nearest. The order depends on the history of calls alone. What a limit
  /// leaves out may stay out if it rises again.
  ///
  /// Distances are Euclidean and rounded down by some units in the last place, never above the exact ones; finite for
  /// boxes with infinite bounds as well, and those beyond the largest finite number are given as that number. They
  /// depend on nothing but the two boxes. No query allocates.
  void query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const;

  /// The same for all pairs that group and mask accept, each once, with the proxy that was created first as `a`.
  void nearest_pairs(S limit, NearPairVisitor<S> visit) const;

  /// The same for pairs of a proxy `a` of this World and `b` of another. Neither World may change during the call. With
  /// itself: as above.
  void nearest_pairs(const BasicWorld& other, S limit, NearPairVisitor<S> visit) const;

  /// A box that contains all valid proxies; invalid (min > max) if there are none.
  Box bounds() const;

  /// Checks every internal invariant; for tests. Throws std::logic_error with the first one broken.
  void validate() const;

 protected:
  struct Impl;
  explicit BasicWorld(std::unique_ptr<Impl> impl) noexcept;

 private:
  std::unique_ptr<Impl> impl_;
};

using World = BasicWorld<float>;
using World64 = BasicWorld<double>;

}  // namespace boxstream
